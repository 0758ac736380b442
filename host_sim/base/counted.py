"""Numbers with their nouns, in sentences."""


def counted(count: int, what: str) -> str:
    """A number and what is counted, in the singular or in the plural.

    >>> counted(1, "seed"), counted(2, "seed")
    ('1 seed', '2 seeds')
    """
    return f"{count} {what}" if count == 1 else f"{count} {what}s"
