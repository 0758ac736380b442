"""Where a robot went as far as its odometers tell: for logs of real bodies, whose world nobody knows."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from host_sim.recording.log_reader import Recording
from host_sim.recording.trajectory import Trajectory
from host_sim.robot_io import Senses
from host_sim.view.history import LearningHistory
from host_sim.view.state import EnvironmentScene
from host_sim.world.geometry import Pose, turned
from host_sim.world.params import SimParams

_SPAN, _COUNTS_PER_MM = 4096, 10
_MARGIN_MM = 500.0


@dataclass(frozen=True)
class _Body:
    """A body of which only the pose is known."""

    pose: Pose
    lifted: bool = False
    eaten: Sequence[bool] = ()


def reckon(recording: Recording, params: SimParams) -> Trajectory:
    """The trajectory of a recording in an empty arena, large enough for it, in whose middle it lies.

    Args:
        recording: Has at least one tick.
        params: The measures; the arena's size counts as the least.
    """
    poses = _ways([tick.senses for tick in recording.ticks], params)
    params, poses = _framed(poses, params)
    trajectory, history = Trajectory(params, recording.boredom_limit), LearningHistory(recording.first_memory)
    trajectory.enter(EnvironmentScene(number=1, of=1, seed=0, first_tick=0, bars=[], food=[]))
    for number, (tick, pose) in enumerate(zip(recording.ticks, poses, strict=True)):
        history.frozen = tick.frozen
        history.take(number, tick.senses, tick.drive, tick.memory)
        trajectory.add(_Body(pose), tick.senses, tick.drive, history)
    return trajectory


def _ways(senses: Sequence[Senses], params: SimParams) -> list[Pose]:
    """The pose after each tick, that is when the next one's odometers are read; the first heading is 0."""
    pose = Pose(0.0, 0.0, 0.0)
    poses = []
    for before, after in pairwise(senses):
        left_mm = _way_mm(before.odometer_left, after.odometer_left)
        right_mm = _way_mm(before.odometer_right, after.odometer_right)
        pose = _rolled(pose, left_mm, right_mm, params.wheel_track_mm)
        poses.append(pose)
    return [*poses, pose]


def _way_mm(before: int, after: int) -> float:
    """The way between two counts, which wrap; it is less than half a round either way."""
    return ((after - before + _SPAN // 2) % _SPAN - _SPAN // 2) / _COUNTS_PER_MM


def _rolled(pose: Pose, left_mm: float, right_mm: float, track_mm: float) -> Pose:
    """The pose after a short arc."""
    turn, way_mm = turned(left_mm, right_mm, track_mm), (left_mm + right_mm) / 2
    middle = pose.heading_rad + turn / 2
    heading = math.remainder(pose.heading_rad + turn, math.tau)
    return Pose(pose.x_mm + way_mm * math.cos(middle), pose.y_mm + way_mm * math.sin(middle), heading)


def _framed(poses: Sequence[Pose], params: SimParams) -> tuple[SimParams, list[Pose]]:
    """An arena with the way in its middle."""
    left, right = min(pose.x_mm for pose in poses), max(pose.x_mm for pose in poses)
    top, bottom = min(pose.y_mm for pose in poses), max(pose.y_mm for pose in poses)
    width = max(params.width_mm, right - left + 2 * _MARGIN_MM)
    height = max(params.height_mm, bottom - top + 2 * _MARGIN_MM)
    dx, dy = (width - left - right) / 2, (height - top - bottom) / 2
    framed = replace(params, width_mm=width, height_mm=height)
    return framed, [Pose(pose.x_mm + dx, pose.y_mm + dy, pose.heading_rad) for pose in poses]
