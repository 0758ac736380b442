"""Files that are written all or nothing."""

from pathlib import Path

from host_sim.errors import OctetError


def write_bytes(path: Path, content: bytes) -> None:
    """Writes a file all or nothing: what was there stays until the new one is whole.

    Raises:
        OctetError: The disk did not take it.
    """
    part = path.with_name(path.name + ".part")
    try:
        part.write_bytes(content)
        part.replace(path)
    except OSError as error:
        raise OctetError(f"cannot write {path}: {error.strerror}") from error
