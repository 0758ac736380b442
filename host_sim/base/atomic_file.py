"""Atomic file writes."""

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from host_sim.base.errors import OctetError
from host_sim.base.system import give_mode, sync_folder


def write_bytes(path: Path, content: bytes) -> None:
    """Writes a file as `replacing` does.

    Raises:
        OctetError: As in `replacing`.
    """
    with replacing(path) as part:
        part.write_bytes(content)


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Replaces a file atomically: an existing file stays as it is until the new one is complete and on the disk.

    A link stays a link: the file that it names is written. An existing file keeps its mode and its owner.

    Yields:
        The path for the new content: an empty file in the same folder. An exception leaves the old file as it is.

    Raises:
        OctetError: The file cannot be written, or is not a regular file, such as a device.
    """
    import tempfile  # noqa: PLC0415 - a run begins sooner, for it ends with this

    try:
        target = Path(os.path.realpath(path))
        before = target.stat() if target.exists() else None
        if before is not None and not stat.S_ISREG(before.st_mode):
            raise OctetError(f"cannot write {path}: it is not a regular file")
        descriptor, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
        os.close(descriptor)
        try:
            yield Path(name)
            _finish(name, before)
            Path(name).replace(target)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
        sync_folder(target.parent)
    except OSError as error:
        raise OctetError(f"cannot write {path}: {error.strerror or error}") from error


def _finish(name: str, before: os.stat_result | None) -> None:
    """Gives the new file the mode and owner of the old one, or of a new file, and syncs it to the disk."""
    descriptor = os.open(name, os.O_RDWR)
    try:
        give_mode(descriptor, before)
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
