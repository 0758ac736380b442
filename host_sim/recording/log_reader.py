"""Reads frame logs, those of `FrameLog` and of `candump -L`, and checks every line."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from host_sim.errors import OctetError, UsageError
from host_sim.protocol.codec import Frame, Protocol, node_of
from host_sim.protocol.generated import CELL_COUNT
from host_sim.protocol.memory_report import MemoryReport
from host_sim.regular_file import read_bytes

_SIZE_MAX = 2_000_000_000
_LINE = re.compile(r"\((\d{1,12})\.(\d{6})\) (\S+) ([0-9A-F]{3})#((?:[0-9A-F]{2}){0,8})")


class Recorded(NamedTuple):
    """One line of a log: robot time in us, and the frame."""

    time_us: int
    frame: Frame


def read_log(path: Path) -> Iterator[Recorded]:
    """Reads a log of `FrameLog` or of `candump -L`.

    Yields:
        Each frame, in order.

    Raises:
        UsageError: The file cannot be read.
        OctetError: The file is empty, or a line is not a frame. A last line without its end is left out.
    """
    try:
        text = read_bytes(path, _SIZE_MAX).decode("ascii")
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise UsageError(f"{path} is not a frame log: it is not text") from None
    if not text:
        raise OctetError(f"{path} is not a frame log: it is empty")
    whole, _, cut = text.rpartition("\n")
    if not whole:
        raise OctetError(f"{path} is not a frame log: no whole line, only {cut[:60]!r}")
    for number, line in enumerate(whole.split("\n"), start=1):
        match = _LINE.fullmatch(line)
        if match is None:
            raise OctetError(f"{path}, line {number}: not a frame in candump -L format: {line[:60]!r}")
        seconds, micros, _, frame_id, data = match.groups()
        yield Recorded(int(seconds) * 1_000_000 + int(micros), Frame(int(frame_id, 16), bytes.fromhex(data)))


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
