"""Composition of an image: flash and RAM by source file, and by function or object.

Link-time optimization merges functions of many files into one: the debugging information tells which source line each
instruction comes from.
"""

import re
from bisect import bisect_right
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from tools.verify.command import output_of

_TOOL = "arm-none-eabi-"
_SYMBOL = re.compile(r": (?P<address>[0-9a-f]+) +(?P<size>\d+) (?P<kind>FUNC|OBJECT) .* (?P<name>\S+)$", re.MULTILINE)
_LINE = re.compile(r"^(?P<file>\S+)\s+(?P<line>\d+|-)\s+0x(?P<address>[0-9a-f]+)", re.MULTILINE)
_SECTION = re.compile(r"^(?P<name>\.\S+)\s+(?P<size>\d+)\s+\d+$", re.MULTILINE)
_FLASH, _RAM = range(0x08000000, 0x10000000), range(0x20000000, 0x30000000)
_SECTIONS = {"flash": (".text", ".data"), "ram": (".noinit", ".data", ".bss")}
_THUMB = 1
_REST = "rest"


@dataclass(frozen=True)
class Piece:
    """A part of an image.

    Attributes:
        module: The source file without its suffix; for an object its own name; "rest" for padding and strings.
        symbol: The function that contains it after inlining, or the object.
        flash: Bytes of flash.
        ram: Bytes of RAM, without the stack.
    """

    module: str
    symbol: str
    flash: int
    ram: int


def _run(tool: str, *arguments: str | Path) -> str:
    return output_of(_TOOL + tool, *arguments)


def _code(image: Path, functions: dict[int, str]) -> Iterator[Piece]:
    starts = sorted(functions)
    for here, there in pairwise(_LINE.finditer(_run("objdump", "--dwarf=decodedline", image))):
        address, size = int(here["address"], 16), int(there["address"], 16) - int(here["address"], 16)
        if here["line"] != "-" and address in _FLASH and size:
            yield Piece(Path(here["file"]).stem, functions[starts[bisect_right(starts, address) - 1]], size, 0)


def _pieces(image: Path) -> Iterator[Piece]:
    functions = {}
    for found in _SYMBOL.finditer(_run("readelf", "--syms", "--wide", image)):
        address, size, name = int(found["address"], 16), int(found["size"]), found["name"].split(".")[0]
        if found["kind"] == "FUNC":
            functions[address & ~_THUMB] = name
        elif address in _FLASH or address in _RAM:
            yield Piece(name, name, *(size if address in memory else 0 for memory in (_FLASH, _RAM)))
    yield from _code(image, functions)


def read_pieces(image: Path) -> list[Piece]:
    """The pieces of an image, which add up to its total size.

    Args:
        image: An ELF file with debugging information.

    Raises:
        VerifyError: The image is not such a file.
    """
    pieces = list(_pieces(image))
    sections = {found["name"]: int(found["size"]) for found in _SECTION.finditer(_run("size", "-A", image))}
    whole = Counter({kind: sum(sections.get(name, 0) for name in names) for kind, names in _SECTIONS.items()})
    named = Counter(flash=sum(piece.flash for piece in pieces), ram=sum(piece.ram for piece in pieces))
    return [*pieces, Piece(_REST, _REST, whole["flash"] - named["flash"], whole["ram"] - named["ram"])]
