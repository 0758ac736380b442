"""Putting an image onto a board."""


class FlashError(Exception):
    """Nothing was flashed; the message says why in one line."""

    exit_code = 1


class ChoiceError(FlashError):
    """The choice does not exist; the message lists those that do."""

    exit_code = 2
