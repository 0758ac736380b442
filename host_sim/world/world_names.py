"""The names of the worlds, without loading them."""

RANDOM, CRATES = "random", "crates"

STILL_WORLDS = (RANDOM, "corridors", "dead-ends", "posts", "crowded", "small")
"""Those in which nothing can be pushed, in the order in which people see them."""

WORLD_NAMES = (*STILL_WORLDS, CRATES)
"""All of them. What stands in the last one can be pushed, which takes pymunk. `worlds.py` has the worlds."""
