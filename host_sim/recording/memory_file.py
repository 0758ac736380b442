"""The eight bytes in a file: exactly eight bytes, cell 0 first."""

from collections.abc import Sequence
from pathlib import Path

from host_sim.atomic_file import write_bytes
from host_sim.errors import UsageError
from host_sim.protocol.generated import CELL_COUNT


def load_memory(path: Path) -> tuple[int, ...] | None:
    """The memory in a file; None if there is no such file yet.

    Raises:
        UsageError: The file cannot be read, or what it holds is no memory.
    """
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise UsageError(f"cannot read the memory file {path}: {error.strerror}") from None
    if len(content) != CELL_COUNT:
        raise UsageError(f"{path} is no memory: it has {len(content)} bytes, not {CELL_COUNT}; it was left as it is")
    for cell, value in enumerate(content):
        if value > (2 if cell else 0):
            allowed = "0 nothing, 1 left, 2 right" if cell else "0 only"
            holds = f"cell {cell} holds {value}, but takes {allowed}"
            raise UsageError(f"{path} is no memory: {holds}; it was left as it is")
    return tuple(content)


def save_memory(path: Path, memory: Sequence[int]) -> None:
    """Writes a memory, all or nothing.

    Raises:
        OctetError: The disk did not take it.
    """
    write_bytes(path, bytes(memory))


def memory_path(path: Path, node: int, robots: int) -> Path:
    """The file of one robot's memory: the path as it is for one robot, and with the node's number for several.

    >>> memory_path(Path("robot.mem"), node=2, robots=3).name
    'robot-2.mem'
    """
    return path if robots == 1 else path.with_name(f"{path.stem}-{node}{path.suffix}")
