"""Putting an image onto a board."""


class FlashError(Exception):
    """Nothing was flashed; the message says why in one line."""

    exit_code = 1


class ChoiceError(FlashError):
    """What was asked for is not there; the message says what is."""

    exit_code = 2
