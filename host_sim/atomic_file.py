"""Atomic file writes."""

from pathlib import Path

from host_sim.errors import OctetError


def write_bytes(path: Path, content: bytes) -> None:
    """Writes a file atomically: an existing file stays as it is until the new one is complete.

    Raises:
        OctetError: The file cannot be written.
    """
    part = path.with_name(path.name + ".part")
    try:
        part.write_bytes(content)
        part.replace(path)
    except OSError as error:
        raise OctetError(f"cannot write {path}: {error.strerror}") from error
