"""The trails in the messages to pages: as many points as a page can tell apart."""

from host_sim.protocol.generated import Reason
from host_sim.recording.trajectory import AXES, ROW, RobotTrack

_REASON = ROW.index("reason")
_USUAL = (Reason.WANDER, Reason.LOOK_AROUND)


def points(track: RobotTrack, ticks: range) -> list[int]:
    """A part of a robot's trail.

    Args:
        track: The robot.
        ticks: Retained ticks. If they have a step, a look around between two small steps is left out; where more than
            that begins, a tick is added: no trial, remembered turn or meal is missing.

    Returns:
        [x, y, reason, ...], x and y in mm.
    """
    first, end, step = ticks.start - track.first_tick, ticks.stop - track.first_tick, ticks.step
    poses, reasons = track.poses_flat, track.rows_flat[first * len(ROW) + _REASON : end * len(ROW) : len(ROW)]
    left_out = None if step == 1 else Reason.LOOK_AROUND
    found: list[int] = []
    before, due = -1, 0
    for i, reason in enumerate(reasons):
        if (i >= due and reason != left_out) or (reason != before and reason not in _USUAL):
            at, due = (first + i) * AXES, i + step
            found += (round(poses[at]), round(poses[at + 1]), reason)
        before = reason
    return found
