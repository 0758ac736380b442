"""Size of an image: its pieces, its worst-case stack, the core alone on other processors, and the table of budgets.

The pieces are flash and RAM by source file, and by function or object. Link-time optimization merges functions of
many files into one: the debugging information tells which source line each instruction comes from.
"""

import re
from bisect import bisect_right
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

from tools.verify.command import ChoiceError, VerifyError, output_of

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


LIBRARY = 32
"""Bytes assumed for each function of the compiler's library, an upper bound; none of these calls another function."""

_NODE = re.compile(r'^node: \{ title: "([^"]+)" label: "[^"]*\\n(\d+) bytes \(([a-z, ]+)\)', re.MULTILINE)
_EDGE = re.compile(r'^edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"', re.MULTILINE)


@dataclass
class CallGraph:
    """A call graph with the stack frame of each function.

    Attributes:
        frames: Bytes of stack of each function, by name; static functions have their file's path as a prefix.
        calls: The functions that each function calls.
    """

    frames: dict[str, int] = field(default_factory=dict)
    calls: defaultdict[str, set[str]] = field(default_factory=lambda: defaultdict(set))

    def add(self, text: str) -> None:
        """Adds the text of a .ci file that the compiler wrote.

        Raises:
            VerifyError: The stack frame of a function is not constant.
        """
        for name, size, kind in _NODE.findall(text):
            if kind != "static":
                raise VerifyError(f"the stack of {name} is {kind}")
            self.frames[name] = int(size)
        for caller, callee in _EDGE.findall(text):
            self.calls[caller].add(callee)

    def worst(self, function: str, above: tuple[str, ...] = ()) -> tuple[int, list[str]]:
        """The deepest call chain from a function: its bytes of stack, and its functions.

        Raises:
            VerifyError: There is recursion, or a call through a pointer.
        """
        if function in above:
            raise VerifyError(f"{function} calls itself, through {' '.join(above)}")
        if function == "__indirect_call":
            raise VerifyError(f"{above[-1]} calls through a pointer")
        deepest, way = 0, list[str]()
        for callee in sorted(self.calls[function]):
            depth, further = self.worst(callee, (*above, function))
            if depth > deepest:
                deepest, way = depth, further
        return self.frames.get(function, LIBRARY) + deepest, [function, *way]


def read_graph(build: Path, image: str) -> CallGraph:
    """The call graph of an image, from link-time optimization and from files compiled without it.

    Args:
        build: The build folder.
        image: The image's name.

    Raises:
        VerifyError: It is missing, or the stack frame of a function is not constant.
    """
    graph = CallGraph()
    linked = sorted(build.glob(f"{image}.elf.ltrans*.ci"))
    if not linked:
        raise VerifyError(f"no call graph of {image} in {build}")
    for path in (*linked, *sorted(build.glob("*/**/*.ci"))):
        graph.add(path.read_text())
    return graph


def worst_stack(graph: CallGraph, roots: Iterable[str]) -> tuple[int, list[str]]:
    """The deepest call chain from any of the roots, each of which begins with an empty stack."""
    return max((graph.worst(root) for root in roots), key=lambda found: found[0])


ROOT = Path(__file__).resolve().parents[2]
_PYTHON = ROOT / ".venv" / "bin" / "python"
_COMMON = ("-std=c99", "-ffreestanding", "-Os", "-ffunction-sections", "-fdata-sections", "-Wall", "-Werror")
_ENTRIES = ("robot_init", "robot_respond", "brain_adopt")
_LENT = 'void lent_{0}(void) __asm__("{1}");\n__attribute__((section(".lent"))) void lent_{0}(void) {{}}\n'
_STATE = '#include "firmware/robot.h"\nstruct robot the_robot;\n'


@dataclass(frozen=True)
class Processor:
    """A compiler and its flags.

    Attributes:
        name: Name in the table of budgets.
        prefix: Prefix of the compiler's tools, such as arm-none-eabi-.
        flags: Compiler flags that select the processor.
    """

    name: str
    prefix: str
    flags: tuple[str, ...]


PROCESSORS = (
    Processor("Cortex-M0", "arm-none-eabi-", ("-mcpu=cortex-m0", "-mthumb")),
    Processor("RV32", "riscv64-unknown-elf-", ("-march=rv32imac", "-mabi=ilp32")),
    Processor("AVR", "avr-", ("-mmcu=atmega328p",)),
)


def compiler_of(prefix: str) -> str:
    """A compiler and its major version, as budgets name it: arm-none-eabi-gcc 12."""
    return f"{prefix}gcc {output_of(f'{prefix}gcc', '-dumpversion').split('.')[0]}"


def _linked(processor: Processor, folder: Path, *libraries: str) -> dict[str, int]:
    """Sizes of the core's sections, by name. Undefined symbols get stubs in `.lent`: any HAL provides them anyway."""
    sources = [path for path in sorted((ROOT / "firmware").rglob("*.c")) if path.name != "main.c"]
    compiler = (f"{processor.prefix}gcc", *processor.flags, *_COMMON, "-I", str(ROOT), "-I", str(folder), "-nostdlib")
    core, lent, program = (folder / f"{processor.name}.{kind}" for kind in ("o", "c", "elf"))
    output_of(*compiler, "-r", *sources, folder / "state.c", *libraries, "-o", core)
    names = [line.split()[-1] for line in output_of(f"{processor.prefix}nm", "--undefined-only", core).splitlines()]
    lent.write_text("".join(_LENT.format(*name) for name in enumerate(names)))
    links = ("-Wl,--gc-sections", f"-Wl,--entry={_ENTRIES[0]}")
    entries = [f"-Wl,--undefined={name}" for name in (*_ENTRIES, "the_robot")]
    output_of(*compiler, *links, *entries, core, lent, "-o", program)
    lines = output_of(f"{processor.prefix}size", "-A", program).splitlines()
    rows = (line.split() for line in lines if line.startswith("."))
    return {row[0]: int(row[1]) for row in rows}


def _flash(sizes: dict[str, int]) -> int:
    return sum(sizes.get(name, 0) for name in (".text", ".rodata", ".srodata", ".data", ".sdata"))


def measure(processor: Processor, folder: Path) -> dict[str, int]:
    """Compiles and links the core for a processor.

    Args:
        processor: The target.
        folder: Folder for the output.

    Raises:
        VerifyError: It does not compile, or the compiler is not installed.

    Returns:
        Bytes: flash, our own code and constants; library, functions of the compiler's library, such as a division
        where the processor has none; ram, the state of one robot.
    """
    (folder / "state.c").write_text(_STATE)
    output_of(_PYTHON, ROOT / "tools" / "generate", "--c", folder / "robot_words.h")
    alone, whole = _linked(processor, folder), _linked(processor, folder, "-lgcc")
    state = sum(size for name, size in alone.items() if name in (".bss", ".sbss"))
    return {"flash": _flash(alone), "library": _flash(whole) - _flash(alone), "ram": state}


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
