"""Reads the robots' frames from a log of a run, candump, python-can, asc2log or CANoe."""

from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.protocol.codec import NODE_MAX, Frame, Protocol, node_of
from host_sim.protocol.every_node import IDS
from host_sim.protocol.generated import CELL_COUNT
from host_sim.protocol.memory_report import MemoryReport
from host_sim.recording.log_files import frames_in
from host_sim.recording.log_text import Recorded

__all__ = ["LogReader", "Recorded", "check_protocol", "first_memory", "frames_of", "nodes_in", "read_log"]

FOREIGN = "foreign"
"""The kind of frames with 11-bit identifiers that no message of any node uses."""

WIRE_1_LAYOUTS = frozenset((0xF6D7, 0x7827))
"""Last bytes of a HEARTBEAT of wire 1: the layout's hash, or in version 1.0 that of octet.dbc."""

_WIRE_1_HEARTBEATS = range(0x181, 0x181 + NODE_MAX)
"""Identifiers of HEARTBEAT in wire 1; the current wire uses none of them."""


class LogReader:
    """The frames of the robots in a log. Each iteration reads the file again, a line at a time.

    Attributes:
        path: The log.
        skipped: Number of other frames by their kind, as of the last iteration.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.skipped: Counter[str] = Counter()

    def __iter__(self) -> Iterator[Recorded]:
        """Yields each frame from or to a robot, in order.

        Raises:
            UsageError: The file cannot be read, is not a log, is damaged, cut short or of wire 1; the message names
                file and line, or the remedy.
        """
        skipped = self.skipped = Counter()
        for read in frames_in(self.path):
            if isinstance(read, str):
                skipped[read] += 1
            elif read.frame.id in IDS:
                yield read
            elif _is_of_wire_1(read.frame):
                raise UsageError(
                    f"{self.path} was recorded with wire 1: convert it with tools/octet convert {self.path} NEW.log"
                )
            else:
                skipped[FOREIGN] += 1

    def note(self) -> str | None:
        """One line about the frames that were skipped; None if there were none."""
        if not self.skipped:
            return None
        *others, last = [f"{count} {kind}" for kind, count in sorted(self.skipped.items())]
        counts = f"{', '.join(others)} and {last}" if others else last
        return f"{self.path}: skipped {counts} frame{'' if sum(self.skipped.values()) == 1 else 's'}"


def _is_of_wire_1(frame: Frame) -> bool:
    """Whether a frame is a HEARTBEAT of wire 1."""
    return frame.id in _WIRE_1_HEARTBEATS and int.from_bytes(frame.data[6:], "little") in WIRE_1_LAYOUTS


def read_log(path: Path) -> LogReader:
    """Returns a reader of the log in a file; see `LogReader`."""
    return LogReader(path)


def nodes_in(log: Iterable[Recorded]) -> list[int]:
    """The nodes that have sent a heartbeat in a log, in ascending order."""
    heartbeats = {Protocol(node).id_of("HEARTBEAT") for node in range(1, NODE_MAX + 1)}
    return sorted({node_of(line.frame.id) for line in log if line.frame.id in heartbeats})


def frames_of(log: Iterable[Recorded], node: int) -> Iterator[Recorded]:
    """Yields the frames from or to one node."""
    return (line for line in log if node_of(line.frame.id) == node)


def check_protocol(log: LogReader, protocol: Protocol) -> None:
    """Checks that a log was recorded with this protocol, that of a robot's node.

    Raises:
        UsageError: The log has no heartbeat of this node, or was recorded with another protocol.
    """
    messages = (protocol.decode(line.frame) for line in log)
    heartbeat = next((message for message in messages if message is not None and message.name == "HEARTBEAT"), None)
    if heartbeat is None:
        raise UsageError(f"{log.path} has no heartbeat of node {protocol.node}: not a log of a run, or cut short")
    if not protocol.fits(heartbeat.signals["layout"]):
        raise UsageError(f"{log.path} was recorded with another octet.dbc: replay it with the version that wrote it")


def first_memory(log: Iterable[Recorded], protocol: Protocol) -> bytes:
    """The robot's memory before the run, which it reports in the handshake: eight bytes."""
    report, memory_id = MemoryReport(), protocol.id_of("MEMORY")
    messages = (protocol.decode(line.frame) for line in log if line.frame.id == memory_id)
    memories = (report.join(message) for message in messages if message is not None)
    return bytes(next((memory for memory in memories if memory is not None), (0,) * CELL_COUNT))
