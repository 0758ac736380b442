"""Reads the robots' frames from a log of a run, candump, python-can, asc2log or CANoe."""

from collections import Counter
from collections.abc import Iterable, Iterator
from functools import cached_property
from itertools import islice
from pathlib import Path

from host_sim.errors import OctetError
from host_sim.protocol.codec import NODE_MAX, Protocol, node_of
from host_sim.protocol.every_node import IDS
from host_sim.protocol.generated import CELL_COUNT
from host_sim.protocol.memory_report import MemoryReport
from host_sim.recording import wire_1
from host_sim.recording.log_files import frames_in
from host_sim.recording.log_text import Recorded

__all__ = ["LogReader", "Recorded", "check_protocol", "first_memory", "frames_of", "nodes_in", "read_log"]

FOREIGN = "foreign"
"""The kind of frames with 11-bit identifiers that belong to no message of any node."""

DAMAGED = "damaged"
"""The kind of damaged frames in an old log. Those of today's wire are read: what they mean is for others to say."""

_RECOGNISED_WITHIN = 50_000
"""Frames within which a log has a heartbeat: there is one a second."""


class LogReader:
    """The frames of the robots in a log. Each iteration reads the file again, a line at a time.

    Attributes:
        path: The log.
        skipped: Number of other frames by their kind, as of the last iteration.
    """

    def __init__(self, path: Path) -> None:
        """Opens nothing yet."""
        self.path = path
        self.skipped: Counter[str] = Counter()

    @cached_property
    def is_old(self) -> bool:
        """Whether the log was recorded with an earlier wire. It is read as if it had been today's."""
        for read in islice(frames_in(self.path), _RECOGNISED_WITHIN):
            if not isinstance(read, str):
                if wire_1.is_heartbeat(read.frame):
                    return True
                decoded = Protocol(max(node_of(read.frame.id), 1)).decode(read.frame)
                if decoded is not None and decoded.name == "HEARTBEAT":
                    return False
        return False

    def __iter__(self) -> Iterator[Recorded]:
        """Yields each frame of a robot or for one, in order.

        Raises:
            UsageError: The file cannot be read, or is not a log.
            OctetError: It is empty, damaged or cut short; the message names file and line.
        """
        skipped = self.skipped = Counter()
        ours = wire_1.IDS if self.is_old else IDS
        transcoder = wire_1.Transcoder() if self.is_old else None
        for read in frames_in(self.path):
            if isinstance(read, str):
                skipped[read] += 1
            elif read.frame.id not in ours:
                skipped[FOREIGN] += 1
            elif transcoder is None:
                yield read
            elif (frames := transcoder.transcode(read)) is None:
                skipped[DAMAGED] += 1
            else:
                yield from frames

    def note(self) -> str | None:
        """One line about the frames that were skipped; None if there were none."""
        if not self.skipped:
            return None
        *others, last = [f"{count} {kind}" for kind, count in sorted(self.skipped.items())]
        counts = f"{', '.join(others)} and {last}" if others else last
        return f"{self.path}: skipped {counts} frame{'' if sum(self.skipped.values()) == 1 else 's'}"


def read_log(path: Path) -> LogReader:
    """The log in a file; see `LogReader`."""
    return LogReader(path)


def nodes_in(log: Iterable[Recorded]) -> list[int]:
    """The nodes that have sent a heartbeat in a log, in ascending order."""
    heartbeats = {Protocol(node).id_of("HEARTBEAT") for node in range(1, NODE_MAX + 1)}
    return sorted({node_of(line.frame.id) for line in log if line.frame.id in heartbeats})


def frames_of(log: Iterable[Recorded], node: int) -> Iterator[Recorded]:
    """The frames of one node, or for it."""
    return (line for line in log if node_of(line.frame.id) == node)


def check_protocol(log: LogReader, protocol: Protocol) -> None:
    """Checks that a log was recorded with this protocol.

    Args:
        log: The log.
        protocol: The protocol of the robot's node.

    Raises:
        OctetError: The log has no heartbeat of this node, or was recorded with another protocol.
    """
    messages = (protocol.decode(line.frame) for line in log)
    heartbeat = next((message for message in messages if message is not None and message.name == "HEARTBEAT"), None)
    if heartbeat is None:
        raise OctetError(f"{log.path} has no heartbeat of node {protocol.node}: not a log of a run, or cut short")
    if not protocol.fits(heartbeat.signals["layout"]):
        raise OctetError(f"{log.path} was recorded with another octet.dbc: replay it with the version that wrote it")


def first_memory(log: Iterable[Recorded], protocol: Protocol) -> bytes:
    """The robot's memory before the run, which it reports in the handshake: eight bytes."""
    report, memory_id = MemoryReport(), protocol.id_of("MEMORY")
    messages = (protocol.decode(line.frame) for line in log if line.frame.id == memory_id)
    memories = (report.join(message) for message in messages if message is not None)
    return bytes(next((memory for memory in memories if memory is not None), (0,) * CELL_COUNT))
