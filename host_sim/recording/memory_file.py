"""The eight bytes in a file: exactly eight bytes, cell 0 first."""

from collections.abc import Sequence
from pathlib import Path

from host_sim.atomic_file import write_bytes
from host_sim.errors import UsageError

CELLS = 8


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
    if len(content) != CELLS:
        raise UsageError(f"{path} is no memory: it has {len(content)} bytes, not {CELLS}; it was left as it is")
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
