"""Reads frame logs back, every line checked: those of `FrameLog`, and candump's own (`candump -L`)."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from host_sim.errors import OctetError, UsageError
from host_sim.protocol.codec import Frame, Protocol, node_of

_LINE = re.compile(r"\((\d+)\.(\d{6})\) (\S+) ([0-9A-F]{3})#((?:[0-9A-F]{2}){0,8})")


class Recorded(NamedTuple):
    """One line of a log: robot time in µs, and the frame."""

    time_us: int
    frame: Frame


def read_log(path: Path) -> Iterator[Recorded]:
    """Reads a log, ours or candump's own.

    Yields:
        Each frame in its order.

    Raises:
        UsageError: The file cannot be read.
        OctetError: A line is no frame, or the last line is cut short; names the line.
    """
    try:
        text = path.read_text(encoding="ascii")
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise UsageError(f"{path} is no frame log: it is not even text") from None
    if not text:
        raise OctetError(f"{path} is empty: no frame log")
    for number, line in enumerate(text.splitlines(keepends=True), start=1):
        match = _LINE.fullmatch(line.rstrip("\n"))
        if match is None or not line.endswith("\n"):
            raise OctetError(f"{path}, line {number}: no frame as candump -L writes it, or cut short: {line[:60]!r}")
        seconds, micros, _, frame_id, data = match.groups()
        yield Recorded(int(seconds) * 1_000_000 + int(micros), Frame(int(frame_id, 16), bytes.fromhex(data)))


def nodes_in(lines: Sequence[Recorded]) -> list[int]:
    """The nodes that are in a log, in their order: those that have sent a heartbeat."""
    heartbeats = {node: Protocol(node).id_of("HEARTBEAT") for node in sorted({node_of(it.frame.id) for it in lines})}
    ids = {line.frame.id for line in lines}
    return [node for node, heartbeat in heartbeats.items() if heartbeat in ids]


def lines_of(lines: Sequence[Recorded], node: int) -> list[Recorded]:
    """The lines of a log without those of other nodes that are in it."""
    others = set(nodes_in(lines)) - {node}
    return [line for line in lines if node_of(line.frame.id) not in others]


def check_protocol(path: Path, lines: Sequence[Recorded], protocol: Protocol) -> None:
    """Sees that a log is one of this protocol.

    Raises:
        OctetError: It is of another, of another node, or of no run.
    """
    said = (protocol.decode(line.frame) for line in lines)
    heartbeat = next((what for what in said if what is not None and what.name == "HEARTBEAT"), None)
    if heartbeat is None:
        raise OctetError(f"{path} has no heartbeat of node {protocol.node}: not a log of a run, or cut short")
    if not protocol.fits(heartbeat.signals["dbc_hash"]):
        raise OctetError(f"{path} was recorded with another octet.dbc: replay it with the version that wrote it")


def first_memory(lines: Sequence[Recorded], protocol: Protocol) -> bytes:
    """What the robot remembered before the run: it says so in the handshake."""
    memory_id = protocol.id_of("MEMORY")
    return next((line.frame.data for line in lines if line.frame.id == memory_id), bytes(8))
