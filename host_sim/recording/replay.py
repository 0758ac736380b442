"""Compares a recorded log with the current firmware."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from host_sim.errors import OctetError
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import Opcode
from host_sim.recording.log_reader import Recorded, check_protocol, first_memory, lines_of
from host_sim.transport.in_process_link import InProcessLink

_TO_ROBOT = ("SENSES", "COMMAND")


@dataclass(frozen=True)
class Difference:
    """The first drive that differs between log and firmware.

    Attributes:
        time_us: Robot time, us.
        recorded: The drive in the log; None if the log has none.
        replayed: The drive of the current firmware; None if it sends none.
    """

    time_us: int
    recorded: Frame | None
    replayed: Frame | None


@dataclass(frozen=True)
class Replay:
    """The result of a replay.

    Attributes:
        drives: Number of equal drives.
        difference: The first difference; None if there is none.
        stopped: Whether the log has the end of the run.
    """

    drives: int
    difference: Difference | None
    stopped: bool = True


def replay(path: Path, lines: Sequence[Recorded], protocol: Protocol) -> Replay:
    """Feeds one robot's senses and commands from a log to the firmware and compares its drives with the log's.

    Args:
        path: Where the lines come from, for messages.
        lines: The whole log.
        protocol: The protocol of the robot's node.

    Raises:
        OctetError: The log is of another protocol, has no heartbeat of this node, or holds a damaged frame.
    """
    lines = lines_of(lines, protocol.node)
    check_protocol(path, lines, protocol)
    link = InProcessLink(protocol.node, first_memory(lines, protocol))
    pending: dict[int, Frame] = {}
    drives, lockstep, stopped = 0, True, False
    for time_us, frame in lines:
        decoded = protocol.decode(frame)
        if decoded is None:
            raise OctetError(f"{path}: damaged or foreign frame at {time_us / 1e6:.2f} s: {protocol.describe(frame)}")
        if decoded.name in _TO_ROBOT:
            lockstep = bool(decoded.signals.get("lockstep", lockstep))
            if pending and lockstep:
                return Replay(drives, Difference(time_us, None, pending.popitem()[1]))
            stopped = decoded.signals.get("opcode") == Opcode.STOP
            pending.update(_drives_for(link, frame, protocol))
        elif decoded.name == "DRIVE":
            answer = pending.pop(decoded.signals["tick"], None)
            # On its own clock a robot that received nothing reports a stop; here it receives everything.
            if answer != frame and not (answer is None and not lockstep and decoded.signals["reason"] == 0):
                return Replay(drives, Difference(time_us, frame, answer))
            drives += answer is not None
    if pending and lockstep and stopped:
        return Replay(drives, Difference(lines[-1].time_us, None, pending.popitem()[1]))
    return Replay(drives, None, stopped)


def report(outcome: Replay, path: Path, protocol: Protocol) -> str:
    """The outcome as text."""
    if outcome.difference is None:
        ending = "" if outcome.stopped else "; the log ends before the run does"
        return f"{path}: {outcome.drives} drives, no difference{ending}"
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
    answers = ((answer, protocol.decode(answer)) for answer in link.taken())
    return {
        decoded.signals["tick"]: answer
        for answer, decoded in answers
        if decoded is not None and decoded.name == "DRIVE"
    }
