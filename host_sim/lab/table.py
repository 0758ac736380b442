"""Tables as text: aligned for a terminal, and in Markdown."""

from collections.abc import Collection, Sequence


def aligned(rows: Sequence[Sequence[str]], right: Collection[int] = ()) -> list[str]:
    """The lines of a table with aligned columns.

    >>> aligned([("node", "lost"), ("1", "0")], right=[1])
    ['node  lost', '1        0']

    Args:
        rows: The cells; all rows have the same number.
        right: Indices of the right-aligned columns.
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = (
        [
            cell.rjust(width) if column in right else cell.ljust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        for row in rows
    )
    return ["  ".join(line).rstrip() for line in lines]


def markdown(rows: Sequence[Sequence[str]]) -> str:
    """A table in Markdown.

    >>> print(markdown([("who", "mean"), ("`article`", "148 s")]))
    | who | mean |
    |---|---|
    | `article` | 148 s |

    Args:
        rows: The cells, the headings first.
    """
    head, *rest = (f"| {' | '.join(row)} |" for row in rows)
    return "\n".join([head, f"|{'---|' * len(rows[0])}", *rest])
