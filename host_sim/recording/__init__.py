"""Recorded runs: log and world file, and what can be derived from them."""
