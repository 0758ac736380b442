"""The still picture of a recorded run: the one that `run` leaves, made from a trajectory."""

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from host_sim.errors import OctetError
from host_sim.recording.trajectory import Trajectory, at
from host_sim.report.picture import draw_run
from host_sim.world.geometry import Bar, Pose
from host_sim.world.layouts import Layout


@dataclass(frozen=True)
class _Chapter:
    """What happened in one environment, as the picture shows it."""

    layout: Layout
    trail: list[tuple[float, float, int]]
    eaten: list[bool]
    robot_s: float

    @property
    def finished(self) -> bool:
        """Whether all the food was eaten."""
        return bool(self.eaten) and all(self.eaten)


def write_still(path: Path, trajectory: Trajectory) -> None:
    """Writes the picture as PNG.

    Raises:
        OctetError: The disk did not take it.
    """
    begun = [tick for tick, kind in trajectory.events() if kind == "environment"]
    episodes = [_episode(trajectory, first, end) for first, end in pairwise([*begun, trajectory.ticks])]
    try:
        draw_run(path, trajectory.params, episodes, at(trajectory.memories, trajectory.ticks - 1))
    except OSError as error:
        raise OctetError(f"cannot write {path}: {error.strerror}") from error


def _episode(trajectory: Trajectory, first: int, end: int) -> _Chapter:
    """What happened from one tick to before another, in the layout of the last of them."""
    rows = slice(first - trajectory.first_tick, end - trajectory.first_tick)
    poses = trajectory.poses()[rows]
    reasons = trajectory.column("reason")[rows].tolist()
    scene = at(trajectory.scenes, end - 1)
    bars = tuple(Bar((ax, ay), (bx, by)) for _, ax, ay, bx, by in scene["bars"])
    food = tuple((x, y) for x, y in scene["food"])
    return _Chapter(
        Layout(bars, food, Pose(*poses[0].tolist())),
        [(x, y, reason) for (x, y), reason in zip(poses[:, :2].tolist(), reasons, strict=True)],
        [bool(eaten) for eaten in at(trajectory.meals, end - 1)],
        (end - first) * trajectory.params.tick_s,
    )
