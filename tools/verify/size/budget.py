"""The table of size budgets: a row for each image and compiler, with `recorded / limit` in each cell."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from tools.verify.command import ChoiceError, VerifyError

COLUMNS = ("flash", "ram", "stack", "instructions")


class Cell(NamedTuple):
    """A recorded size and its limit, in bytes or instructions."""

    recorded: int
    limit: int

    def __str__(self) -> str:
        return f"{self.recorded} / {self.limit}"


Key = tuple[str, str]
"""An image, or the core on a processor, and the compiler, as `arm-none-eabi-gcc 12`."""


@dataclass(frozen=True)
class Budget:
    """A table of budgets.

    Attributes:
        head: The text before the table.
        rows: The cells of each row, by column.
    """

    head: str
    rows: dict[Key, dict[str, Cell]]

    def of(self, what: str, compiler: str) -> Mapping[str, Cell]:
        """The row of an image.

        Raises:
            VerifyError: There is no row for this compiler.
        """
        if (what, compiler) not in self.rows:
            raise VerifyError(f"no budget for {what} with {compiler}: add a row, and tools/size --record fills it in")
        return self.rows[what, compiler]

    def record(self, what: str, compiler: str, sizes: Mapping[str, int]) -> None:
        """Replaces the recorded sizes of an image; its limits stay."""
        cells = self.of(what, compiler)
        self.rows[what, compiler] = {name: cell._replace(recorded=sizes[name]) for name, cell in cells.items()}

    def write(self, path: Path) -> None:
        """Writes the table with aligned columns."""
        texts = [[*key, *(str(cells.get(name, "")) for name in COLUMNS)] for key, cells in self.rows.items()]
        widths = [max(map(len, column)) for column in zip(*texts, ["", "", *COLUMNS], strict=True)]
        lines = ["what", "compiler", *COLUMNS], ["-" * width for width in widths], *texts
        rows = [" | ".join(text.ljust(width) for text, width in zip(line, widths, strict=True)) for line in lines]
        path.write_text(self.head + "".join(f"| {row} |\n" for row in rows))


def read(path: Path) -> Budget:
    """Reads the table in a file.

    Raises:
        ChoiceError: The file cannot be read or has no valid table.
    """
    try:
        head, bar, text = path.read_text().partition("| what ")
        lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in (bar + text).splitlines()]
        if not lines[2:]:
            raise ValueError("there is no row")
        return Budget(head, {(what, compiler): _cells(cells) for what, compiler, *cells in lines[2:]})
    except (OSError, ValueError) as error:
        raise ChoiceError(f"cannot read {path}: {error!r}") from error


def _cells(texts: list[str]) -> dict[str, Cell]:
    pairs = zip(COLUMNS, (text.partition("/") for text in texts), strict=True)
    return {name: Cell(int(recorded), int(limit)) for name, (recorded, bar, limit) in pairs if recorded or bar}
