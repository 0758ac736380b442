"""The course of a run: what the robot sensed and did, tick by tick, whenever it reported what it knows."""

import hashlib
from pathlib import Path

from host_sim.client.frame_log import FrameLog
from host_sim.protocol.codec import Protocol

_NODE = 1
_OF_COURSE = tuple(f" {Protocol(_NODE).id_of(name):03X}#".encode() for name in ("SENSES", "DRIVE"))


class CourseLog(FrameLog):
    """A log that knows the course of its run, too."""

    def __init__(self, path: Path | None = None) -> None:
        """As in `FrameLog`."""
        self._course = hashlib.sha256()
        super().__init__(path)

    @property
    def course(self) -> str:
        """SHA-256 of the lines of the course that were written, in hexadecimal."""
        return self._course.hexdigest()

    def _write(self, block: bytes) -> None:
        for line in block.splitlines():
            if any(name in line for name in _OF_COURSE):
                self._course.update(line)
        super()._write(block)
