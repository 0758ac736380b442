"""A robot in its world, tick by tick."""
