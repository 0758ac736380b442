"""What can find overlaps, by name, for those who only name it."""

FAST, PYMUNK = "fast", "pymunk"

PHYSICS = (PYMUNK, FAST)
"""The reference, and what does the same in C."""
