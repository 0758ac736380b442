"""The names of the worlds, for those who only name them."""

RANDOM = "random"

WORLD_NAMES = (RANDOM, "corridors", "dead-ends", "posts", "crowded", "small")
"""In the order in which people see them. `worlds.py` has the worlds."""
