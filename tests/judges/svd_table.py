"""Makes svd.txt: what the makers' SVD files say of the chips, as Rust crates hand it on.

In an empty folder, with cargo, `cargo init`, `cargo add stm32f1@=0.16.0 stm32f4@=0.16.0 stm32g4@=0.16.0
rp2040-pac@=0.6.0` and `cargo vendor` unpack them into `vendor`; then, in the project's folder:

    .venv/bin/python -m tests.judges.svd_table VENDOR

Only addresses, reset values and bit positions are taken over, and only of what chips.toml compares.
"""

import argparse
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from xml.etree.ElementTree import Element, parse

from tests.judges.chips import COMPARED, TABLE, fields_compared

PERIPHERAL = re.compile(r"pub type (\w+) = crate::Periph<(\w+)::RegisterBlock, (0x[\da-f_]+)>")
MEMBER = re.compile(
    r"///0x([\da-f]+)(?:\.\.0x([\da-f]+))? - [^\n]*\n(?:\s*///[^\n]*\n)*\s*#\[inline\(always\)\]\s*"
    r"pub const fn (\w+)\(&self(, n: usize)?\) -> &(?:super::)?(\w+)"
)
FIELD = re.compile(
    r"///Bits? (\d+)(?::(\d+))?(?: - [^\n]*)?\n(?:\s*///[^\n]*\n)*\s*#\[inline\(always\)\]\s*"
    r"pub fn (\w+)\(&(?:mut )?self\)"
)
RESET = re.compile(r"RESET_VALUE: u\d+ = (0x[\da-f_]+|\d+)")


def number(text: str) -> int:
    """A number as Rust writes it."""
    return int(text.replace("_", ""), 0)


def registers(folder: Path, name: str) -> Iterator[tuple[int, str, Path]]:
    """Offset, name and file of each register of a block; elements of an array have a number in their names."""
    text = (folder / f"{name}.rs").read_text()
    members = [(int(m[1], 16), int(m[2] or "0", 16), *m.groups()[2:]) for m in MEMBER.finditer(text)]
    named = {offset for offset, _, _, index, _ in members if not index}
    for offset, end, member, index, kind in members:
        file = file_of(folder, name, kind.lower(), text)
        if not index:
            yield from element(file, member, offset)
        elif offset not in named:
            count = number(re.search(rf"\b{member}: \[{kind}; (\d+)\]", text)[1])  # type: ignore[index]
            for i in range(count):
                yield from element(file, f"{member}{i}", offset + (end - offset) // count * i)


def file_of(folder: Path, block: str, kind: str, text: str) -> Path:
    """The file of a kind of register of a block, which may be another block's, or another kind by another name."""
    others = re.search(rf"pub use crate::\w+::(\w+)::{kind};", text)
    alike = re.search(rf"pub use (?:self::)?(\w+) as {kind};", text)
    return folder / (others[1] if others else block) / f"{alike[1] if alike else kind}.rs"


def element(file: Path, name: str, offset: int) -> Iterator[tuple[int, str, Path]]:
    """As `registers`, for a register or a group of them."""
    inner = list(registers(file.parent, file.stem)) or [(0, "", file)]
    for more, register, of in inner:
        yield offset + more, f"{name}.{register}" if register else name, of


def bits(text: str) -> dict[str, tuple[int, int]]:
    """The lowest and the highest bit of each field of a register."""
    return {m[3].upper(): (int(m[1]), int(m[2] or m[1])) for m in FIELD.finditer(text)}


def block_rows(device: Path, block: str, wanted: Mapping[str, set[str]]) -> Iterator[str]:
    """The rows of a block: offset, name and reset value of each register, and its fields that are wanted."""
    for offset, register, file in registers(device, block):
        reset = RESET.search(file.read_text())
        yield row(offset, register.upper(), number(reset[1]) if reset else 0, bits(file.read_text()), wanted)


def row(
    offset: int, register: str, reset: int, fields: Mapping[str, tuple[int, int]], wanted: Mapping[str, set[str]]
) -> str:
    """The row of a register."""
    chosen = sorted(wanted.get(register, set()) & fields.keys())
    places = (f"{it}={fields[it][0]}:{fields[it][1]}" for it in chosen)
    return " ".join((f"0x{offset:03x} {register} 0x{reset:08x}", *places))


def rows(device: Path, chip: str) -> Iterator[str]:
    """The rows of a chip. A peripheral whose registers are the same as those of an earlier one only names it."""
    text, seen = (device / "mod.rs").read_text(), {}
    for name, named, base in PERIPHERAL.findall(text):
        if name not in COMPARED[chip].values():
            continue
        borrowed = re.search(rf"pub use self::(\w+) as {named};", text)
        block = tuple(block_rows(device, borrowed[1] if borrowed else named, fields_compared(chip, name)))
        first = seen.setdefault(block, name)
        yield f"{chip} {name} 0x{number(base):08x} {first}"
        yield from block if first == name else ()


def text_of(element: Element, name: str, default: str = "0") -> str:
    """The text of a part of an element."""
    return element.findtext(name, default)


def svd_registers(parent: Element, at: int = 0, prefix: str = "") -> Iterator[tuple[int, str, Element]]:
    """Offset, name and element of each register of an SVD file's peripheral; as `registers`."""
    for it in parent:
        if it.tag not in ("register", "cluster"):
            continue
        offset, stride = at + number(text_of(it, "addressOffset")), number(text_of(it, "dimIncrement"))
        for i in range(number(text_of(it, "dim", "1"))):
            name = prefix + text_of(it, "name").replace("%s", str(i))
            if it.tag == "cluster":
                yield from svd_registers(it, offset + i * stride, f"{name}.")
            else:
                yield offset + i * stride, name, it


def svd_fields(register: Element) -> dict[str, tuple[int, int]]:
    """The lowest and the highest bit of each field of a register."""
    found = {}
    for field in register.iterfind("fields/field"):
        high, low = re.findall(r"\d+", text_of(field, "bitRange"))
        found[text_of(field, "name").upper()] = (int(low), int(high))
    return found


def svd_rows(file: Path, chip: str) -> Iterator[str]:
    """As `rows`, from an SVD file."""
    for peripheral in parse(file).iterfind("peripherals/peripheral"):
        name = text_of(peripheral, "name")
        block = peripheral.find("registers")
        if name not in COMPARED[chip].values():
            continue
        wanted = fields_compared(chip, name)
        first = peripheral.get("derivedFrom", name)
        yield f"{chip} {name} 0x{number(text_of(peripheral, 'baseAddress')):08x} {first}"
        for offset, register, element in svd_registers(block) if block is not None else ():
            reset = number(text_of(element, "resetValue"))
            yield row(offset, register.upper(), reset, svd_fields(element), wanted)


def main() -> None:
    """Writes the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("vendor", type=Path, metavar="VENDOR", help="the folder that cargo vendor filled")
    vendor = parser.parse_args().vendor
    versions, lines = [], []
    for chip in COMPARED:
        crate = vendor / ("rp2040-pac" if chip == "rp2040" else chip[:7])
        version = re.search(r'\nversion = "(.+?)"', (crate / "Cargo.toml").read_text())
        versions.append(f"{crate.name} {version[1] if version else ''}")
        svd = crate / "svd" / f"{chip}.svd.patched"
        lines += svd_rows(svd, chip) if svd.exists() else rows(crate / "src" / chip, chip)
    head = f"# SVD facts of the Rust crates {', '.join(versions)}, made by tests/judges/svd_table.py: see there."
    TABLE.write_text("\n".join((head, *lines, "")))


if __name__ == "__main__":
    main()
