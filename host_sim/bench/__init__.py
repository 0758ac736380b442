"""How fast it all is, and whether it is the same everywhere: `tools/bench`."""
