"""The registry of checks by the sentence numbers of docs/protocol.md, and their common functions."""

from collections.abc import Callable, Mapping

from host_sim.lab.check.talk import BrokenError, Talk
from host_sim.protocol.generated import Fault, Reason
from host_sim.transport.link import Frame

Check = Callable[[Talk], None]

CHECKS: dict[str, Check] = {}
"""The checks by sentence number. Each gets a robot that was just powered up and has answered a first command."""

SECOND = 50
"""Ticks in a second."""

AT_ONCE_S = 0.05
"""Time after which a frame counts as missing, s; after a longer time, a robot on its own clock reports silence."""

REPORTS = ("HEARTBEAT", "BOOT", "MEMORY", "FAULTS", "HEALTH")
"""The messages of a whole report."""

_TRIES = 20


def sentence(number: str) -> Callable[[Check], Check]:
    """Registers a check."""

    def note(check: Check) -> Check:
        CHECKS[number] = check
        return check

    return note


def unhurried(talk: Talk, attempt: Check) -> None:
    """Makes an attempt that silence would spoil; repeats it if this computer was so slow that silence occurred.

    Raises:
        BrokenError: The attempt fails, or silence occurred each time.
    """
    for _ in range(_TRIES):
        first = len(talk.said)
        broken = None
        try:
            attempt(talk)
        except BrokenError as error:
            broken = error
        if not any(_heard_silence(said.signals) for said in talk.said[first:]):
            if broken is not None:
                raise broken
            return
    raise BrokenError("it heard silence at once, however soon the next SENSES came")


def _heard_silence(signals: Mapping[str, int]) -> bool:
    """Whether a robot reports silence: in a DRIVE, or in an EMERGENCY after the next SENSES."""
    return signals.get("reason") == Reason.SILENCE or bool(signals.get("kinds", 0) >> Fault.SILENCE & 1)


def damaged(frame: Frame) -> Frame:
    """A copy of a frame with a wrong CRC."""
    return Frame(frame.id, bytes([frame.data[0] ^ 0xFF]) + frame.data[1:])
