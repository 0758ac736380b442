"""What the checks share: where they are noted, by the numbers of docs/protocol.md."""

from collections.abc import Callable, Mapping

from host_sim.base.frame import Frame
from host_sim.lab.check.talk import BrokenError, Talk
from host_sim.protocol.generated import Fault, Reason

Check = Callable[[Talk], None]

CHECKS: dict[str, Check] = {}
"""By the sentence's number. Each gets a robot that was just powered up, and has answered a first command."""

SECOND = 50
"""Ticks."""

AT_ONCE_S = 0.05
"""What has not come by then does not come; after a longer time, a robot on its own clock hears silence."""

REPORTS = ("HEARTBEAT", "BOOT", "MEMORY", "FAULTS", "HEALTH")
"""What a whole report is made of."""

_TRIES = 20


def sentence(number: str) -> Callable[[Check], Check]:
    """Notes a check."""

    def note(check: Check) -> Check:
        CHECKS[number] = check
        return check

    return note


def unhurried(talk: Talk, attempt: Check) -> None:
    """Tries something that silence would spoil, again if this computer was so slow that the robot heard silence.

    Raises:
        BrokenError: It fails, or silence came each time.
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
    """Whether a robot says so: in a DRIVE, or in an EMERGENCY once the next SENSES have come."""
    return signals.get("reason") == Reason.SILENCE or bool(signals.get("kinds", 0) >> Fault.SILENCE & 1)


def damaged(frame: Frame) -> Frame:
    """The frame with a wrong CRC."""
    return Frame(frame.id, bytes([frame.data[0] ^ 0xFF]) + frame.data[1:])
