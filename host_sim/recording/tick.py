"""One control tick of a recording."""

from typing import NamedTuple

from host_sim.protocol.generated import Drive, Senses


class Tick(NamedTuple):
    """One control tick.

    Attributes:
        senses: The body's senses.
        drive: The drive that the body applied: the robot's answer, or an earlier one that was still held.
        memory: The robot's eight cells when it answered.
        frozen: Whether learning was frozen.
        started: The robot's eight cells when it was started again since the tick before; None if it was not.
        written: Its eight cells after each report between the two ticks, since it was started if it was.
    """

    senses: Senses
    drive: Drive
    memory: tuple[int, ...]
    frozen: bool
    started: tuple[int, ...] | None = None
    written: tuple[tuple[int, ...], ...] = ()
