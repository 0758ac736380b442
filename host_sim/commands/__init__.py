"""What each command of `tools/octet` does, and what `tools/bench` measures."""
