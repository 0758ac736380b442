"""The names of the physics engines, without loading them."""

FAST, PYMUNK = "fast", "pymunk"

PHYSICS = (PYMUNK, FAST)
"""The reference, and what does the same in C."""
