"""Size of the core alone, without a HAL, on processors that we have no board for."""

from dataclasses import dataclass
from pathlib import Path

from tools.verify.command import output_of

ROOT = Path(__file__).resolve().parents[3]
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
