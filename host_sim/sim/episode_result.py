"""The result of one environment of a run."""

from dataclasses import dataclass, field

from host_sim.protocol.generated import CELL_COUNT


@dataclass
class RobotResult:
    """The result of one robot in one environment.

    Attributes:
        node: Its node number on the bus.
        begun: Number of actions begun, by reason.
        food_eaten: Number of pieces of food that it ate.
        collisions: Number of collisions: times that its body began to touch something.
        stuck_sensors: Number of proximity sensors that are stuck at the end.
        memory: The eight cells at the end.
    """

    node: int
    begun: dict[int, int] = field(default_factory=dict)
    food_eaten: int = 0
    collisions: int = 0
    stuck_sensors: int = 0
    memory: tuple[int, ...] = (0,) * CELL_COUNT


@dataclass
class EpisodeResult:
    """The result of one environment.

    Attributes:
        tick_s: Length of a tick, s.
        robots: The result of each robot.
        ticks: Number of ticks.
        eaten: For each piece of food, whether it was eaten.
    """

    tick_s: float
    robots: list[RobotResult]
    ticks: int = 0
    eaten: list[bool] = field(default_factory=list)

    @property
    def finished(self) -> bool:
        """Whether all the food was eaten."""
        return bool(self.eaten) and all(self.eaten)

    @property
    def robot_s(self) -> float:
        """Robot time spent here, s."""
        return round(self.ticks * self.tick_s, 3)

    def begun(self, reason: int) -> int:
        """The number of actions that all robots began for a reason."""
        return sum(robot.begun.get(reason, 0) for robot in self.robots)
