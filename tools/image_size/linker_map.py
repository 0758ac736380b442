"""What is in an image, as its linker map says: each symbol's size in flash and in RAM."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

_KEPT = "Linker script and memory map"
_SECTION = re.compile(
    r"^ (?P<name>\.[\w.]+|COMMON)\s+0x(?P<address>[0-9a-f]+)\s+0x(?P<size>[0-9a-f]+) (?P<object>\S.*)$", re.MULTILINE
)
_LONG_NAME = re.compile(r"^( \.[\w.]+)\n +0x", re.MULTILINE)
_FILL = re.compile(r"^ \*fill\*\s+0x(?P<address>[0-9a-f]+)\s+0x(?P<size>[0-9a-f]+)", re.MULTILINE)
_OBJECT = re.compile(r"(?P<name>[\w.-]+?)(\.c)?\.o(bj)?\)?$")
_FLASH, _RAM = range(0x08000000, 0x10000000), range(0x20000000, 0x30000000)


@dataclass(frozen=True)
class Piece:
    """A symbol's share of an image.

    Attributes:
        module: The source file, without its ending; "library" for the compiler's own.
        symbol: The section's name behind its kind: a function or an object.
        flash: Bytes of flash.
        ram: Bytes of RAM, without the stack.
    """

    module: str
    symbol: str
    flash: int
    ram: int


def _module_of(path: str) -> str:
    found = _OBJECT.search(path)
    if found is None or path.startswith("/usr/"):
        return "library"
    return found["name"]


def _symbol_of(section: str, path: str) -> str:
    symbol = re.sub(r"^\.(text|rodata|data|bss|noinit)\.?", "", section).lstrip(".")
    found = _OBJECT.search(path)
    return symbol or (found["name"] if found else path)


def _piece(module: str, symbol: str, address: int, size: int) -> Iterator[Piece]:
    if size and (address in _FLASH or address in _RAM):
        yield Piece(module, symbol, size if address in _FLASH else 0, size if address in _RAM else 0)


def _kept_in(path: Path) -> str:
    """The part of a map that tells of what is in the image, each section on one line."""
    text = path.read_text()
    if _KEPT not in text:
        raise ValueError(f"{path} is no linker map")
    return _LONG_NAME.sub(r"\1 0x", text[text.index(_KEPT) :])


def read_map(path: Path) -> list[Piece]:
    """The pieces of an image, in the order of their addresses, padding included.

    Raises:
        ValueError: It is no linker map.
    """
    text = _kept_in(path)
    pieces: list[Piece] = []
    for found in _SECTION.finditer(text):
        module, symbol = _module_of(found["object"]), _symbol_of(found["name"], found["object"])
        pieces += _piece(module, symbol, int(found["address"], 16), int(found["size"], 16))
    for found in _FILL.finditer(text):
        address = int(found["address"], 16)
        if address in _FLASH:  # in the RAM it is the room for the stack
            pieces += _piece("padding", "fill", address, int(found["size"], 16))
    return pieces


def objects_in(path: Path) -> set[str]:
    """Names of the object files in an image, those in archives included, such as `crc8.c.obj`.

    Raises:
        ValueError: It is no linker map.
    """
    names = (found["object"] for found in _SECTION.finditer(_kept_in(path)))
    return {re.split(r"[/(]", name.rstrip(")"))[-1] for name in names}
