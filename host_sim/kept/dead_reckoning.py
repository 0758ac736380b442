"""Where a robot went as far as its odometers tell: for logs of real bodies, whose world nobody knows."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from host_sim.kept.recording import Recording
from host_sim.kept.story import Story
from host_sim.kept.trajectory import Trajectory
from host_sim.live.scene import EnvironmentScene
from host_sim.wire.signals import Senses
from host_sim.world.environment import Pose, World, turned

_SPAN, _COUNTS_PER_MM = 4096, 10
_MARGIN_MM = 500.0


@dataclass(frozen=True)
class _Body:
    """A body of which only the pose is known."""

    pose: Pose
    lifted: bool = False
    eaten: Sequence[bool] = ()


def reckon(recording: Recording, world: World) -> Trajectory:
    """The trajectory of a recording in an empty arena, large enough for it, in whose middle it lies.

    Args:
        recording: Has at least one tick.
        world: The measures; the arena's size counts as the least.
    """
    poses = _ways([tick.senses for tick in recording.ticks], world)
    world, poses = _framed(poses, world)
    trajectory, story = Trajectory(world, recording.boredom_limit), Story(recording.first_memory)
    trajectory.enter(EnvironmentScene(number=1, of=1, seed=0, first_tick=0, bars=[], food=[]))
    for number, (tick, pose) in enumerate(zip(recording.ticks, poses, strict=True)):
        story.frozen = tick.frozen
        story.take(number, tick.senses, tick.drive, tick.memory)
        trajectory.add(_Body(pose), tick.senses, tick.drive, story)
    return trajectory


def _ways(senses: Sequence[Senses], world: World) -> list[Pose]:
    """The pose after each tick, that is when the next one's odometers are read; the first heading is 0."""
    pose = Pose(0.0, 0.0, 0.0)
    poses = []
    for before, after in pairwise(senses):
        left_mm = _way_mm(before.odometer_left, after.odometer_left)
        right_mm = _way_mm(before.odometer_right, after.odometer_right)
        pose = _rolled(pose, left_mm, right_mm, world.wheel_track_mm)
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


def _framed(poses: Sequence[Pose], world: World) -> tuple[World, list[Pose]]:
    """An arena with the way in its middle."""
    left, right = min(pose.x_mm for pose in poses), max(pose.x_mm for pose in poses)
    top, bottom = min(pose.y_mm for pose in poses), max(pose.y_mm for pose in poses)
    width = max(world.width_mm, right - left + 2 * _MARGIN_MM)
    height = max(world.height_mm, bottom - top + 2 * _MARGIN_MM)
    dx, dy = (width - left - right) / 2, (height - top - bottom) / 2
    framed = replace(world, width_mm=width, height_mm=height)
    return framed, [Pose(pose.x_mm + dx, pose.y_mm + dy, pose.heading_rad) for pose in poses]
