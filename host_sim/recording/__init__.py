"""Recorded runs: log and world file, and the data derived from them."""
