"""Compares headers, drivers, linker scripts and emulated chips with what the makers' SVD files say of them."""

import re
from collections.abc import Collection, Iterator, Mapping
from contextlib import suppress
from fnmatch import fnmatch
from functools import cache
from typing import Any

from cffi import FFI, CDefError, FFIError

from host_sim.base.c_interface import c_interface
from host_sim.base.paths import ROOT
from host_sim.emulator.chips import CHIPS
from host_sim.emulator.flash import BASE
from host_sim.emulator.hardware import Faults, Hardware
from host_sim.emulator.registers import BoardError, Register
from tests.judges.chips import COMPARED, SETUP, Svd, entries, fields_of

CORE = ("SysTick", "SCB", "NVIC")
"""Peripherals of the core, which ARM describes, not ST."""
ALIASES: Mapping[str, str] = SETUP["aliases"]


def named(ours: str) -> set[str]:
    """The names that the SVD files may have for a register."""
    names = {ours.upper()}
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
    """What a register reads after power-up; None if the emulator refuses to say."""
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
