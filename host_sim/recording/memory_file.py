"""Memory files: exactly eight bytes, cell 0 first."""

from collections.abc import Sequence
from pathlib import Path

from host_sim.atomic_file import write_bytes
from host_sim.errors import UsageError
from host_sim.protocol.generated import CELL_COUNT, CELL_MAX, SIDES


def load_memory(path: Path) -> tuple[int, ...] | None:
    """The memory in a file, or None if the file does not exist.

    Raises:
        UsageError: The file cannot be read, or is not a memory file.
    """
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise UsageError(f"cannot read the memory file {path}: {error.strerror}") from None
    if len(content) != CELL_COUNT:
        raise UsageError(f"{path} is not a memory file: {len(content)} bytes, expected {CELL_COUNT} (file unchanged)")
    for cell, (value, most) in enumerate(zip(content, CELL_MAX, strict=True)):
        if value > most:
            allowed = ", ".join(f"{side} {name}" for side, name in enumerate(SIDES[: most + 1]))
            raise UsageError(
                f"{path} is not a memory file: cell {cell} holds {value}, allowed is {allowed} (file unchanged)"
            )
    return tuple(content)


def save_memory(path: Path, memory: Sequence[int]) -> None:
    """Writes a memory file atomically.

    Raises:
        OctetError: The file cannot be written.
    """
    write_bytes(path, bytes(memory))


def memory_path(path: Path, node: int, robots: int) -> Path:
    """The memory file of a robot: the path itself in a run with one robot, else with the node number added.

    >>> memory_path(Path("robot.mem"), node=2, robots=3).name
    'robot-2.mem'
    """
    return path if robots == 1 else path.with_name(f"{path.stem}-{node}{path.suffix}")
