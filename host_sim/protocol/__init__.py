"""The bus protocol: frames and what they say."""
