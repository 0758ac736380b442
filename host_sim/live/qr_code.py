"""An address as a QR code, for a phone's camera: in a terminal, and on a page."""

import io
import os
from typing import Any, TextIO

from host_sim.base.extra_library import library

BORDER = 2
"""Width of the light border, modules."""

_LIGHT_ON_DARK, _PLAIN = "\x1b[97;40m", "\x1b[0m"
_LINES_BESIDE = 4
"""Lines of a terminal that are left for the address and what belongs to it."""


def modules_of(text: str) -> list[str]:
    """The rows of the code, without a border: 1 for a dark module, 0 for a light one."""
    return ["".join("01"[bool(module)] for module in row) for row in _code(text).matrix]


def lines_for(text: str, out: TextIO) -> list[str]:
    """The code in half blocks for a terminal; nothing where it would not fit or could not be read.

    Args:
        text: Content of the code.
        out: The stream to which the lines will be written.
    """
    code = _code(text)
    width, height = code.symbol_size(border=BORDER)
    if not _takes_blocks(out) or not _has_room(out, width, (height + 1) // 2):
        return []
    drawn = io.StringIO()
    code.terminal(out=drawn, border=BORDER, compact=True)
    return [f"{_LIGHT_ON_DARK}{line}{_PLAIN}" for line in drawn.getvalue().splitlines()]


def _code(text: str) -> Any:
    return library("segno", "classroom").make(text, micro=False)


def _takes_blocks(out: TextIO) -> bool:
    """Whether this is a terminal that can show half blocks in given colours."""
    if not out.isatty() or os.environ.get("TERM", "dumb") == "dumb":
        return False
    return (out.encoding or "").replace("-", "").lower() == "utf8"


def _has_room(out: TextIO, columns: int, lines: int) -> bool:
    try:
        size = os.get_terminal_size(out.fileno())
    except (OSError, ValueError):
        return False
    return size.columns >= columns and size.lines >= lines + _LINES_BESIDE
