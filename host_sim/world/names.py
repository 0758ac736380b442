"""The names of the worlds and of the physics engines, without loading them."""

RANDOM, CRATES = "random", "crates"

STILL_WORLDS = (RANDOM, "corridors", "dead-ends", "posts", "crowded", "small")
"""Those in which nothing can be pushed, in the order in which people see them."""

WORLD_NAMES = (*STILL_WORLDS, CRATES)
"""All of them. What stands in the last one can be pushed, which takes pymunk. `worlds.py` has the worlds."""


FAST, PYMUNK = "fast", "pymunk"

PHYSICS = (PYMUNK, FAST)
"""The reference, and what does the same in C."""
