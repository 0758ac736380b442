"""The host side of the protocol: commands, senses, drives, and pacing."""
