"""What happened in a run that its result depends on."""

from typing import NamedTuple


class Incident(NamedTuple):
    """Something that should not happen in a run.

    Attributes:
        tick: Number of the tick, from the first of the run.
        node: Node number of the robot.
        text: What happened, as a sentence without a full stop.
    """

    tick: int
    node: int
    text: str

    def __str__(self) -> str:
        return f"at tick {self.tick} (node {self.node}) {self.text}"
