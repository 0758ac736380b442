"""Compares headers, drivers, linker scripts and emulated chips with the makers' SVD files.

It also makes svd.txt, which has their contents as Rust crates publish them. In an empty folder, with cargo,
`cargo init`, `cargo add stm32f1@=0.16.0 stm32f4@=0.16.0 stm32g4@=0.16.0 rp2040-pac@=0.6.0` and `cargo vendor` unpack
them into `vendor`; then, in the project's folder:

    .venv/bin/python -m tests.judges.svd_judge VENDOR

Only addresses, reset values and bit positions are taken over, and only of what chips.toml compares.
"""

import argparse
import re
from collections.abc import Collection, Iterator, Mapping
from contextlib import suppress
from fnmatch import fnmatch
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element, parse

from cffi import FFI, CDefError, FFIError

from host_sim.base.c_interface import c_interface
from host_sim.base.paths import ROOT
from host_sim.emulator.chips import CHIPS
from host_sim.emulator.flash import BASE
from host_sim.emulator.hardware import Faults, Hardware
from host_sim.emulator.registers import BoardError, Register
from tests.judges.chips import COMPARED, SETUP, TABLE, Svd, entries, fields_compared, fields_of, together

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
        yield from together(block) if first == name else ()


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
        yield from together(
            row(offset, register.upper(), number(text_of(it, "resetValue")), svd_fields(it), wanted)
            for offset, register, it in (svd_registers(block) if block is not None else ())
        )


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
    head = f"# SVD facts of the Rust crates {', '.join(versions)}, made by tests/judges/svd_judge.py: see there."
    TABLE.write_text("\n".join((head, *lines, "")))


CORE = ("SysTick", "SCB", "NVIC")
"""Peripherals of the core, which ARM describes, not ST."""
ALIASES: Mapping[str, str] = SETUP["aliases"]


def named(ours: str) -> set[str]:
    """The names that the SVD files may have for a register: without brackets, with _ for a dot, or an alias."""
    plain = re.sub(r"[][]", "", ours).upper()
    names = {plain, plain.replace(".", "_")}
    for pattern, theirs in ALIASES.items():
        if match := re.fullmatch(re.escape(pattern).replace(r"\#", r"(\d+)"), ours):
            number = int(match[1]) if match.groups() else 0
            names |= set(theirs.replace("#", str(number)).replace("+", str(number + 1)).split())
    return names


def misplaced(svd: Svd, name: str, address: int) -> bool:
    """Whether something else than this register is at an address."""
    return named(name).isdisjoint(it.name.removesuffix("_OUTPUT") for it in svd.at(address))


def bases(svds: Mapping[str, Svd]) -> Iterator[tuple[str, str]]:
    """Each difference of an address in a chip's linker script, and what it is."""
    for chip, svd in svds.items():
        own = next((ROOT / "hal").rglob(f"{chip}.ld"))
        shared = own.parents[1] / "stm32.ld"
        text = own.read_text() + (shared.read_text() if shared.exists() else "")
        for name, value in re.findall(r"(?m)^(\w+) *= (0x[\dA-F]+);", text):
            theirs = svd.bases.get(COMPARED[chip].get(name, ""))
            if int(value, 16) != theirs:
                yield f"{chip} base {name}", f"{value}, SVD {theirs if theirs is None else hex(theirs)}"


def members(kind: Any, prefix: str = "") -> Iterator[tuple[str, int]]:
    """Name and offset of each word in a structure or an array."""
    if kind.kind == "array":
        for i in range(kind.length):
            inner = members(kind.item, f"{prefix}[{i}]")
            yield from ((name, at + i * FFI().sizeof("uint32_t") * words(kind.item)) for name, at in inner)
    elif kind.kind == "struct":
        for name, part in kind.fields:
            inner = members(part.type, f"{prefix}.{name}" if prefix else name)
            yield from ((it, at + part.offset) for it, at in inner if not name.startswith("reserved"))
    else:
        yield prefix, 0


def words(kind: Any) -> int:
    """The number of words in a type."""
    if kind.kind == "array":
        return int(kind.length) * words(kind.item)
    return sum(words(part.type) for _, part in kind.fields) if kind.kind == "struct" else 1


def offsets(svds: Mapping[str, Svd]) -> Iterator[tuple[str, str]]:
    """Each register of a header that is somewhere else."""
    for entry in entries("structures"):
        text = (ROOT / entry.file).read_text()
        ffi = c_interface("\n".join(line for line in text.splitlines() if not line.startswith("#")))
        svd = svds[entry.chip]
        base = svd.bases[COMPARED[entry.chip][entry.says]]
        for name, offset in members(ffi.typeof(f"struct {entry.name}")):
            if misplaced(svd, name, base + offset):
                there = [it.name for it in svd.at(base + offset)]
                yield f"{entry.chip} offset {entry.name}.{name}", f"0x{offset:x}, where the SVD has {there}"


@cache
def constants(text: str) -> Any:
    """The constants of a C source that are plain numbers: enumerators, initialisers, and static ones."""
    ffi, source = FFI(), re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    for name, value in re.findall(r"(\w+) = ([^,;{}]+?)\s*[,;}]", source):
        with suppress(CDefError, FFIError):
            ffi.cdef(f"enum {{ {name} = {value.strip()} }};", override=True)
    return ffi.dlopen(None)


def drivers(svds: Mapping[str, Svd]) -> Iterator[tuple[str, str]]:
    """Each constant of a driver that stands for other bits."""
    for entry in entries("constants"):
        ours = int(getattr(constants((ROOT / entry.file).read_text()), entry.name)) & 0xFFFFFFFF
        theirs = 0
        for (peripheral, register), name, value in fields_of(entry):
            low, high = svds[entry.chip].field(peripheral, register, name)
            whole = (1 << high - low + 1) - 1
            theirs |= low if entry.says.startswith("@") else (int(value) if value else whole) << low
        if ours != theirs:
            yield f"{entry.chip} bits {entry.file} {entry.name}", f"0x{ours:x}, SVD 0x{theirs:x}"


def reset_value(register: Register) -> int | None:
    """The value of a register after power-up; None if the emulator refuses the read."""
    try:
        return register.read()
    except BoardError:
        return None


def power_up(chip: str) -> Hardware:
    """A chip after power-up."""
    hardware = Hardware(CHIPS[COMPARED[chip]["board"]], Faults(), lambda _: None, lambda _: None)
    hardware.flash_image([(BASE, bytes(8))])
    hardware.restart("power")
    return hardware


def emulated(svds: Mapping[str, Svd]) -> Iterator[tuple[str, str]]:
    """Each register of an emulated chip that is somewhere else, or has another value after power-up."""
    for chip, svd in ((chip, svd) for chip, svd in svds.items() if "board" in COMPARED[chip]):
        hardware = power_up(chip)
        for peripheral in hardware.peripherals:
            if peripheral.name in CORE:
                continue
            base = hardware.chip.places[peripheral.name][0]
            if base != svd.bases.get(COMPARED[chip].get(peripheral.name, "")):
                yield f"{chip} emulated {peripheral.name}", f"at 0x{base:x}"
            for offset, register in peripheral.registers.items():
                where, there = f"{chip} emulated {peripheral.name}.{register.name}", svd.at(base + offset)
                value, resets = reset_value(register), {it.reset for it in there}
                if misplaced(svd, register.name, base + offset):
                    yield where, f"at 0x{offset:x}, where the SVD has {[it.name for it in there]}"
                elif value not in resets:
                    yield where, f"{value} after power-up, SVD {resets}"


JUDGES = (bases, offsets, drivers, emulated)


def unexplained(found: Collection[tuple[str, str]], exceptions: Mapping[str, str]) -> list[str]:
    """The differences that no exception covers, and each exception that covers none."""
    left = [f"{what}: {how}" for what, how in found if not any(fnmatch(what, it) for it in exceptions)]
    unused = [it for it in exceptions if not any(fnmatch(what, it) for what, _ in found)]
    return left + [f"the exception {it} is not needed" for it in unused]


if __name__ == "__main__":
    main()
