"""A robot's path by dead reckoning from its odometers, for logs of real bodies, whose world is not known."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from host_sim.protocol.generated import ODOMETER_COUNTS_PER_MM, ODOMETER_SPAN, Senses
from host_sim.recording.recording import Recording
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.state_types import EnvironmentScene
from host_sim.recording.trajectory import Trajectory
from host_sim.world.body import rolled
from host_sim.world.geometry import Pose, SimParams

_MARGIN_MM = 500.0


def reckon(recording: Recording, node: int, params: SimParams) -> Trajectory:
    """The trajectory of a recording of at least one tick, in the middle of an empty arena.

    The arena has at least the size of `params`, and is larger if the path needs it.
    """
    poses = _poses([tick.senses for tick in recording.ticks], params)
    params, poses = _framed(poses, params)
    recorder = RunRecorder(params, recording.boredom_limit, {node: recording.first_memory})
    recorder.enter(EnvironmentScene(number=1, of=1, seed=0, first_tick=0, start_tick=0, bars=[], food=[]))
    for tick, pose in zip(recording.ticks, poses, strict=True):
        recorder.add(0, tick, pose)
    return recorder.trajectory


def _poses(senses: Sequence[Senses], params: SimParams) -> list[Pose]:
    """The pose after each tick, when the next odometers are read; the first heading is 0."""
    pose = Pose(0.0, 0.0, 0.0)
    poses = []
    for before, next_ in pairwise(senses):
        pose = after(pose, before, next_, params)
        poses.append(pose)
    return [*poses, pose]


def after(pose: Pose, before: Senses, now: Senses, params: SimParams) -> Pose:
    """The pose of a body at `now`, having rolled from `pose` since `before`."""
    left_mm = _distance_mm(before.odometer_left, now.odometer_left)
    right_mm = _distance_mm(before.odometer_right, now.odometer_right)
    return rolled(pose, left_mm, right_mm, params.wheel_track_mm)


def _distance_mm(before: int, now: int) -> float:
    """The distance between two counts, which wrap, if it is less than half of their range."""
    return ((now - before + ODOMETER_SPAN // 2) % ODOMETER_SPAN - ODOMETER_SPAN // 2) / ODOMETER_COUNTS_PER_MM


def _framed(poses: Sequence[Pose], params: SimParams) -> tuple[SimParams, list[Pose]]:
    """The dimensions of an arena with the path in its middle, and the poses there."""
    left, right = min(pose.x_mm for pose in poses), max(pose.x_mm for pose in poses)
    top, bottom = min(pose.y_mm for pose in poses), max(pose.y_mm for pose in poses)
    width = max(params.width_mm, right - left + 2 * _MARGIN_MM)
    height = max(params.height_mm, bottom - top + 2 * _MARGIN_MM)
    dx, dy = (width - left - right) / 2, (height - top - bottom) / 2
    framed = replace(params, width_mm=width, height_mm=height)
    return framed, [Pose(pose.x_mm + dx, pose.y_mm + dy, pose.heading_rad) for pose in poses]
