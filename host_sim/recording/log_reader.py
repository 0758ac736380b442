"""Reads the robots' frames from a log, whoever wrote it: a run, candump, python-can, asc2log or CANoe."""

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from host_sim.errors import OctetError
from host_sim.protocol.codec import Protocol, node_of
from host_sim.protocol.every_node import IDS
from host_sim.protocol.generated import CELL_COUNT
from host_sim.protocol.memory_report import MemoryReport
from host_sim.recording.log_files import frames_in
from host_sim.recording.log_text import Recorded

__all__ = ["LogReader", "Recorded", "check_protocol", "first_memory", "lines_of", "nodes_in", "read_log"]

FOREIGN = "foreign"
"""The kind of frames with 11-bit identifiers that belong to no message of any node."""


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

    def __iter__(self) -> Iterator[Recorded]:
        """Yields each frame of a robot or for one, in order.

        Raises:
            UsageError: The file cannot be read, or is not a log.
            OctetError: It is empty, damaged or cut short; the message names file and line.
        """
        skipped = self.skipped = Counter()
        for read in frames_in(self.path):
            if isinstance(read, str):
                skipped[read] += 1
            elif read.frame.id in IDS:
                yield read
            else:
                skipped[FOREIGN] += 1

    def note(self) -> str | None:
        """One line about the frames that were skipped; None if there were none."""
        if not self.skipped:
            return None
        *others, last = [f"{count} {kind}" for kind, count in sorted(self.skipped.items())]
        counts = f"{', '.join(others)} and {last}" if others else last
        return f"{self.path}: skipped {counts} frame{'' if self.skipped.total() == 1 else 's'}"


def read_log(path: Path) -> LogReader:
    """The log in a file; see `LogReader`."""
    return LogReader(path)


def nodes_in(lines: Sequence[Recorded]) -> list[int]:
    """The nodes that have sent a heartbeat in a log, in ascending order."""
    heartbeats = {node: Protocol(node).id_of("HEARTBEAT") for node in sorted({node_of(it.frame.id) for it in lines})}
    ids = {line.frame.id for line in lines}
    return [node for node, heartbeat in heartbeats.items() if heartbeat in ids]


def lines_of(lines: Sequence[Recorded], node: int) -> list[Recorded]:
    """The lines of a log without those of the other nodes that have sent a heartbeat."""
    others = set(nodes_in(lines)) - {node}
    return [line for line in lines if node_of(line.frame.id) not in others]


def check_protocol(path: Path, lines: Sequence[Recorded], protocol: Protocol) -> None:
    """Checks that a log was recorded with this protocol.

    Args:
        path: Where the lines come from, for messages.
        lines: The log.
        protocol: The protocol of the robot's node.

    Raises:
        OctetError: The log has no heartbeat of this node, or was recorded with another protocol.
    """
    messages = (protocol.decode(line.frame) for line in lines)
    heartbeat = next((message for message in messages if message is not None and message.name == "HEARTBEAT"), None)
    if heartbeat is None:
        raise OctetError(f"{path} has no heartbeat of node {protocol.node}: not a log of a run, or cut short")
    if not protocol.fits(heartbeat.signals["layout"]):
        raise OctetError(f"{path} was recorded with another octet.dbc: replay it with the version that wrote it")


def first_memory(lines: Sequence[Recorded], protocol: Protocol) -> bytes:
    """The robot's memory before the run, which it reports in the handshake: eight bytes."""
    report, memory_id = MemoryReport(), protocol.id_of("MEMORY")
    messages = (protocol.decode(line.frame) for line in lines if line.frame.id == memory_id)
    memories = (report.join(message) for message in messages if message is not None)
    return bytes(next((memory for memory in memories if memory is not None), (0,) * CELL_COUNT))
