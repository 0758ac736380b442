"""The names of the worlds and of the physics engines, without loading them."""

RANDOM, CRATES = "random", "crates"

STILL_WORLDS = (RANDOM, "corridors", "dead-ends", "posts", "crowded", "small")
"""Worlds in which nothing can be pushed, in the order in which people see them."""

WORLD_NAMES = (*STILL_WORLDS, CRATES)
"""All worlds; `worlds.py` has them. Robots can push the obstacles of the last one, which takes pymunk."""


FAST, PYMUNK = "fast", "pymunk"

PHYSICS = (PYMUNK, FAST)
"""The reference, and its equivalent in C."""
