"""`tools/octet replay`: a recorded log against the firmware of today."""

from dataclasses import dataclass
from pathlib import Path

from host_sim.client.frame_log import Recorded, read_log
from host_sim.errors import OctetError
from host_sim.protocol.codec import Frame, Protocol
from host_sim.transport.in_process_link import InProcessLink

_TO_ROBOT = ("SENSES", "COMMAND")


@dataclass(frozen=True)
class Difference:
    """The first tick at which the firmware does something else than the log.

    Attributes:
        time_us: Robot time.
        recorded: What the log has; None if it has nothing.
        replayed: What the firmware says now; None if it says nothing.
    """

    time_us: int
    recorded: Frame | None
    replayed: Frame | None


@dataclass(frozen=True)
class Replay:
    """How a replay went.

    Attributes:
        drives: Drives that were the same.
        difference: The first that was not; None if all were.
    """

    drives: int
    difference: Difference | None


def replay(path: Path, protocol: Protocol) -> Replay:
    """Feeds a log's senses and commands to the firmware and compares its drives.

    Raises:
        UsageError: The file cannot be read.
        OctetError: It is no log, or one of another protocol or node.
    """
    lines = list(read_log(path))
    check_protocol(path, lines, protocol)
    link = InProcessLink(protocol.node, first_memory(lines, protocol))
    pending: dict[int, Frame] = {}
    drives, lockstep = 0, True
    for time_us, frame in lines:
        said = protocol.decode(frame)
        if said is None:
            raise OctetError(f"{path}: damaged or foreign frame at {time_us / 1e6:.2f} s: {protocol.describe(frame)}")
        if said.name in _TO_ROBOT:
            lockstep = bool(said.signals.get("lockstep", lockstep))
            if pending and lockstep:
                return Replay(drives, Difference(time_us, None, pending.popitem()[1]))
            pending.update(_drives_for(link, frame, protocol))
        elif said.name == "DRIVE":
            answer = pending.pop(said.signals["tick"], None)
            # On its own clock a robot that heard nothing also says so; here it always hears.
            if answer != frame and not (answer is None and not lockstep and said.signals["reason"] == 0):
                return Replay(drives, Difference(time_us, frame, answer))
            drives += answer is not None
    if pending and lockstep:
        return Replay(drives, Difference(lines[-1].time_us, None, pending.popitem()[1]))
    return Replay(drives, None)


def tell(outcome: Replay, path: Path, protocol: Protocol) -> str:
    """The outcome for people."""
    if outcome.difference is None:
        return f"{path}: {outcome.drives} drives, no difference"
    difference = outcome.difference
    return "\n".join(
        (
            f"{path}: differs after {outcome.drives} equal drives, at {difference.time_us / 1e6:.2f} s of robot time",
            f"  recorded  {_described(difference.recorded, protocol)}",
            f"  replayed  {_described(difference.replayed, protocol)}",
        )
    )


def _described(frame: Frame | None, protocol: Protocol) -> str:
    return "nothing" if frame is None else protocol.describe(frame)


def _drives_for(link: InProcessLink, frame: Frame, protocol: Protocol) -> dict[int, Frame]:
    """The drives with which the firmware answers a frame, by tick."""
    link.send(frame)
    said = ((answer, protocol.decode(answer)) for answer in link.taken())
    return {what.signals["tick"]: answer for answer, what in said if what is not None and what.name == "DRIVE"}


def check_protocol(path: Path, lines: list[Recorded], protocol: Protocol) -> None:
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


def first_memory(lines: list[Recorded], protocol: Protocol) -> bytes:
    """What the robot remembered before the run: it says so when greeted."""
    memory_id = protocol.id_of("MEMORY")
    return next((line.frame.data for line in lines if line.frame.id == memory_id), bytes(8))
