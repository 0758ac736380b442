"""The facts about chips that are compared with ST's SVD files: chips.toml, and svd.txt, which svd_judge.py makes."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from host_sim.base.toml_file import parse_toml

FOLDER = Path(__file__).parent
TABLE = FOLDER / "svd.txt"
SETUP: Mapping[str, Any] = parse_toml((FOLDER / "chips.toml").read_text())
COMPARED: Mapping[str, Mapping[str, str]] = {
    chip: {**{name: name for name in names["same"].split()}, **names} for chip, names in SETUP["chips"].items()
}
"""The peripherals of each chip, and its board."""


@dataclass(frozen=True)
class Constant:
    """A constant of a driver, and the fields that it stands for."""

    chip: str
    file: str
    name: str
    says: str


def entries(kind: str) -> Iterator[Constant]:
    """The entries of `structures` or `constants`."""
    for table in SETUP[kind]:
        for chip in table["chips"]:
            for name in table.keys() - {"file", "chips"}:
                says = table[name]
                by_chip = {"others": says} if isinstance(says, str) else says
                yield Constant(chip, table["file"], name, by_chip.get(chip) or by_chip["others"])


def fields_of(entry: Constant) -> Iterator[tuple[tuple[str, str], str, str]]:
    """Peripheral and register, field, and value of each field of a constant; the value may be empty."""
    for part in re.split(r"\s*\|\s*", entry.says):
        peripheral, register, name, value = re.fullmatch(r"@?(\w+)\.([\w.]+)\.(\w+)(?:=(\d+))?", part).groups("")  # type: ignore[union-attr]
        yield (COMPARED[entry.chip][peripheral], register), name, value


def fields_compared(chip: str, peripheral: str) -> dict[str, set[str]]:
    """The fields of a peripheral that are compared, by register."""
    found: dict[str, set[str]] = {}
    for entry in entries("constants"):
        for (of, register), name, _ in fields_of(entry) if entry.chip == chip else ():
            if of == peripheral:
                found.setdefault(register, set()).add(name)
    return found


@dataclass(frozen=True)
class SvdRegister:
    """A register in the table: its name, its reset value, and the lowest and highest bit of its fields."""

    name: str
    reset: int
    fields: Mapping[str, tuple[int, int]]


@dataclass(frozen=True)
class Svd:
    """The facts about a chip in the table.

    Attributes:
        bases: the address of each peripheral.
        registers: the registers of each peripheral, by offset; several may share one.
    """

    bases: dict[str, int] = field(default_factory=dict)
    registers: dict[str, dict[int, list[SvdRegister]]] = field(default_factory=dict)

    def at(self, address: int) -> list[SvdRegister]:
        """The registers at an address."""
        return [it for name, base in self.bases.items() for it in self.registers[name].get(address - base, ())]

    def field(self, peripheral: str, register: str, name: str) -> tuple[int, int]:
        """The lowest and highest bit of a field."""
        all_of = {it.name: it.fields for row in self.registers[peripheral].values() for it in row}
        return all_of[register][name]


RANGE = re.compile(r"0x([\da-f]+)\+0x([\da-f]+) (\S*)\[(\d+)-(\d+)\](.*)")
"""A row for registers that differ by a number in their names: first offset, distance, and the numbers."""


def each_of(rows: Iterable[str]) -> Iterator[str]:
    """The rows of a block, one for each register."""
    for row in rows:
        if match := RANGE.fullmatch(row):
            offset, step, first, last = int(match[1], 16), int(match[2], 16), int(match[4]), int(match[5])
            for i in range(last - first + 1):
                yield f"0x{offset + i * step:03x} {match[3]}{first + i}{match[6]}"
        else:
            yield row


def together(rows: Iterable[str]) -> Iterator[str]:
    """The rows of a block, with one for three or more registers that differ by a number and are equally far apart."""
    left = {name: (int(offset, 16), rest) for offset, name, rest in (row.split(" ", 2) for row in rows)}
    while left:
        name = next(iter(left))
        offset, rest = left[name]
        row, names = f"0x{offset:03x} {name} {rest}", [name]
        for match in re.finditer(r"\d+", name):
            head, first, tail = name[: match.start()], int(match[0]), name[match.end() :]
            step = left.get(f"{head}{first + 1}{tail}", (0, ""))[0] - offset
            run = [name]
            while left.get(another := f"{head}{first + len(run)}{tail}") == (offset + len(run) * step, rest):
                run.append(another)
            if len(run) > max(2, len(names)):
                row, names = f"0x{offset:03x}+0x{step:x} {head}[{first}-{first + len(run) - 1}]{tail} {rest}", run
        yield row
        for it in names:
            del left[it]


def read_table(text: str) -> dict[str, Svd]:
    """The facts of each chip."""
    chips = {chip: Svd() for chip in COMPARED}
    block: dict[int, list[SvdRegister]] = {}
    for line in each_of(text.splitlines()[1:]):
        first, name, value, *more = line.split()
        if first in chips:
            registers = chips[first].registers
            block = registers[name] = registers.get(more[0], {})
            chips[first].bases[name] = int(value, 16)
        else:
            pairs = (place.replace("=", ":").split(":") for place in more)
            fields = {it: (int(low), int(high)) for it, low, high in pairs}
            block.setdefault(int(first, 16), []).append(SvdRegister(name, int(value, 16), fields))
    return chips
