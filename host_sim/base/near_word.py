"""Did-you-mean suggestions."""

from collections.abc import Iterable


def near_word(word: str, words: Iterable[str]) -> str | None:
    """The most similar word; None if none is similar.

    >>> near_word("corridor", ["random", "corridors"])
    'corridors'
    """
    from difflib import get_close_matches  # noqa: PLC0415 - only mistakes need it

    return next(iter(get_close_matches(word, list(words), 1)), None)


def meant(word: object, words: Iterable[object]) -> str:
    """The end of a message about an unknown word: the nearest known word, or all of them if none is near.

    >>> meant("artcle", ["article", "fixed"])
    'did you mean article?'
    """
    every = [str(each) for each in words]
    near = near_word(str(word), every)
    return f"did you mean {near}?" if near else f"choose from {', '.join(every)}"
