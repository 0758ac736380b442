"""Putting an image onto a board."""


class FlashError(Exception):
    """Nothing was flashed; the message says why in one line."""
