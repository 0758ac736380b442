"""The bus protocol: frames and their contents."""
