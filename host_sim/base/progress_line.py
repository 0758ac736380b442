"""A progress line, drawn by rich on a terminal and removed at the end."""

import sys
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress

_EVERY_S = 0.25


class ProgressLine:
    """One line on stderr, rewritten now and then and removed on leaving a `with` block; none without a terminal."""

    def __init__(self, total: int | None = None, *, shown: bool = True) -> None:
        """Creates the line.

        Args:
            total: Number of steps, for a bar and an estimate of the time left; None if it is not known.
            shown: Whether to show the line.
        """
        self._then = 0.0
        self._progress = _progress(total) if shown and sys.stderr.isatty() else None

    def __enter__(self) -> "ProgressLine":
        return self

    def __exit__(self, *_: object) -> None:
        self.clear()

    def is_due(self) -> bool:
        """Whether it is time to show something new."""
        return self._progress is not None and time.monotonic() >= self._then + _EVERY_S

    def show(self, text: str, done: int = 0) -> None:
        """Rewrites the line.

        Args:
            text: Text of the line.
            done: Number of steps done.
        """
        if self._progress is not None:
            self._then = time.monotonic()
            self._progress.update(self._progress.task_ids[0], description=text, completed=done)
            self._progress.start()
            self._progress.refresh()

    def clear(self) -> None:
        """Removes the line, so that other output can be printed."""
        if self._progress is not None:
            self._progress.stop()


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
