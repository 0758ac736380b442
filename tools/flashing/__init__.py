"""Putting an image onto a board."""
