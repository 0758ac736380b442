"""Did-you-mean suggestions."""

from collections.abc import Iterable


def near_word(word: str, words: Iterable[str]) -> str | None:
    """The most similar word; None if none is similar.

    >>> near_word("corridor", ["random", "corridors"])
    'corridors'
    """
    from difflib import get_close_matches  # noqa: PLC0415 - only mistakes need it

    return next(iter(get_close_matches(word, list(words), 1)), None)
