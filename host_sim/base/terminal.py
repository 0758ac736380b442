"""Colours on a terminal, and a progress line, drawn by rich and removed at the end."""

import os
import sys
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, TextIO, TypeVar

if TYPE_CHECKING:
    from rich.progress import Progress


RED, GREEN = 31, 32


def is_terminal(stream: TextIO) -> bool:
    """Whether a stream is a terminal that understands escape sequences."""
    return stream.isatty() and os.environ.get("TERM", "dumb") != "dumb"


def coloured(text: str, colour: int, stream: TextIO) -> str:
    """A text for a stream, in a colour if it is a terminal and NO_COLOR (no-color.org) is not set."""
    wanted = is_terminal(stream) and not os.environ.get("NO_COLOR")
    return f"\x1b[{colour}m{text}\x1b[39m" if wanted else text


def linked(path: Path) -> str:
    """The name of a file for standard output, as a hyperlink if the terminal may support it."""
    if not is_terminal(sys.stdout) or os.environ.get("TERM") == "linux":
        return str(path)
    return f"\x1b]8;;{path.absolute().as_uri()}\x1b\\{path}\x1b]8;;\x1b\\"


_EVERY_S = 0.25
SOON_S = 1.0
"""Time that a short task may take before a line shows how far it is, s."""

T = TypeVar("T")


class ProgressLine:
    """One line on stderr, rewritten now and then and removed on leaving a `with` block; none without a terminal."""

    def __init__(self, total: int | None = None, *, shown: bool = True, after_s: float = 0.0) -> None:
        """Creates the line.

        Args:
            total: Number of steps, for a bar and an estimate of the time left; None if it is not known.
            shown: Whether to show the line.
            after_s: Time until it is due for the first time, s.
        """
        self._due_s = time.monotonic() + after_s
        self._progress = _progress(total) if shown and sys.stderr.isatty() else None

    def __enter__(self) -> "ProgressLine":
        return self

    def __exit__(self, *_: object) -> None:
        self.clear()

    def is_due(self) -> bool:
        """Whether it is time to show something new."""
        return self._progress is not None and time.monotonic() >= self._due_s

    def show(self, text: str, done: int = 0) -> None:
        """Rewrites the line.

        Args:
            text: Text of the line.
            done: Number of steps done.
        """
        if self._progress is not None:
            self._due_s = time.monotonic() + _EVERY_S
            self._progress.update(self._progress.task_ids[0], description=text, completed=done)
            self._progress.start()
            self._progress.refresh()

    def clear(self) -> None:
        """Removes the line, so that other output can be printed."""
        if self._progress is not None:
            self._progress.stop()


def counted(items: Iterable[T], total: int | None, text: str, *, after_s: float = 0.0) -> Iterator[T]:
    """The items as they come, while a progress line counts them; see `ProgressLine`."""
    with ProgressLine(total, after_s=after_s) as line:
        for done, item in enumerate(items, 1):
            if line.is_due():
                line.show(text, done)
            yield item


def _progress(total: int | None) -> "Progress":
    # Loaded late: most runs have no terminal.
    from rich.console import Console  # noqa: PLC0415
    from rich.progress import (  # noqa: PLC0415
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeRemainingColumn,
    )
    from rich.table import Column  # noqa: PLC0415

    text = TextColumn("{task.description}", markup=False, table_column=Column(no_wrap=True, overflow="ellipsis"))
    columns = (text,) if total is None else (BarColumn(), MofNCompleteColumn(), text, TimeRemainingColumn())
    progress = Progress(
        *columns,
        console=Console(stderr=True, highlight=False),
        auto_refresh=False,
        transient=True,
        redirect_stdout=False,
        redirect_stderr=False,
    )
    progress.add_task("", total=total)
    return progress
