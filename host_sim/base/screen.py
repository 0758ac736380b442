"""A full-screen terminal display that restores what was on the screen before."""

import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TextIO

_HOME, _REST_OF_LINE, _REST_OF_SCREEN = "\x1b[H", "\x1b[K", "\x1b[J"
_ENTER, _LEAVE = "\x1b[?1049h\x1b[?25l", "\x1b[?25h\x1b[?1049l"


@contextmanager
def full_screen(out: TextIO) -> Iterator[Callable[[Sequence[str]], None]]:
    """Yields a function that draws lines, cut to the screen's size; restores the terminal at the end."""

    def draw(lines: Sequence[str]) -> None:
        width, height = shutil.get_terminal_size()
        shown = [f"{line[:width]}{_REST_OF_LINE}" for line in lines[: height - 1]]
        out.write(f"{_HOME}{chr(10).join(shown)}\n{_REST_OF_SCREEN}")
        out.flush()

    out.write(_ENTER)
    try:
        yield draw
    finally:
        out.write(_LEAVE)
        out.flush()
