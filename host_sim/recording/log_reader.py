"""Reads the robots' frames from a log of a run, candump, python-can, asc2log or CANoe."""

from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.protocol.codec import NODE_MAX, MemoryReport, Protocol, node_of
from host_sim.protocol.every_node import IDS
from host_sim.protocol.generated import CELL_COUNT
from host_sim.recording.log_files import frames_in
from host_sim.recording.log_text import OTHER, Recorded

__all__ = ["LogReader", "Recorded", "check_protocol", "first_memory", "frames_of", "nodes_in", "read_log"]

FOREIGN = "foreign"
"""The kind of frames with 11-bit identifiers that no message of any node uses."""

ELSEWHERE = "other-channel"
"""The kind of the robots' frames on other channels than the wanted one."""


class LogReader:
    """The frames of the robots in a log. Each iteration reads the file again, a line at a time.

    Attributes:
        path: The log.
        channel: The only interface or channel that is read; None if the robots' are the only one.
        skipped: Number of other frames by their kind, as of the last iteration.
    """

    def __init__(self, path: Path, channel: str | None = None) -> None:
        self.path, self.channel = path, channel
        self.skipped: Counter[str] = Counter()

    def __iter__(self) -> Iterator[Recorded]:
        """Yields each frame from or to a robot, in order.

        Raises:
            UsageError: The file cannot be read, is not a log, is damaged or cut short; the message names file and
                line.
        """
        skipped = self.skipped = Counter()
        channels: dict[int, bytes | str] = {}
        wanted = None if self.channel is None else (self.channel, self.channel.encode())
        for channel, read in frames_in(self.path):
            if isinstance(read, str):
                skipped[read] += 1
            elif read.frame.id not in IDS:
                skipped[FOREIGN] += 1
            elif wanted is not None and channel not in wanted:
                skipped[ELSEWHERE] += 1
            else:
                if channels.setdefault(read.frame.id, channel) != channel:
                    raise self._mixed(read.frame.id, channels[read.frame.id], channel)
                yield read
        if wanted is not None and not channels:
            raise UsageError(f"{self.path} has no robot on {self.channel}: leave --channel out, or name another")

    def _mixed(self, frame_id: int, *channels: bytes | str) -> UsageError:
        one, other = (it.decode("ascii", "replace") if isinstance(it, bytes) else it for it in channels)
        node = node_of(frame_id)
        return UsageError(f"{self.path}: node {node} is on {one} and on {other}: choose one, such as --channel {one}")

    def note(self) -> str | None:
        """One line about the frames that were skipped; None if there were none."""
        if not self.skipped:
            return None
        counts = sorted((kind, count) for kind, count in self.skipped.items() if kind != OTHER)
        *first, last = [f"{count} {kind}" for kind, count in counts] or [""]
        parts = []
        if counts:
            frames = "frame" if sum(count for _, count in counts) == 1 else "frames"
            parts.append(f"{', '.join(first)} and {last} {frames}" if first else f"{last} {frames}")
        if events := self.skipped[OTHER]:
            parts.append(f"{events} line{'' if events == 1 else 's'} without a frame")
        return f"{self.path}: skipped {', and '.join(parts)}"


def read_log(path: Path, channel: str | None = None) -> LogReader:
    """Returns a reader of the log in a file; see `LogReader`."""
    return LogReader(path, channel)


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
