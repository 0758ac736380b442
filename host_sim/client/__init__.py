"""The host's side of the protocol: commands, senses, drives, and pacing."""
