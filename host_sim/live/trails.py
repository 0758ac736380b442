"""The trails in the messages to pages: as many points as a page can tell apart."""

from host_sim.protocol.generated import Reason
from host_sim.recording.trajectory import AXES, ROW, RobotTrack

_REASON = ROW.index("reason")
_USUAL = (Reason.WANDER, Reason.LOOK_AROUND)


def points(track: RobotTrack, ticks: range) -> list[int]:
    """A part of a robot's trail.

    Args:
        track: The robot.
        ticks: Retained ticks. Between them, those are added in which something more begins than a look around or the
            next step: no trial, remembered turn or meal is left out.

    Returns:
        [x, y, reason, ...], x and y in mm.
    """
    first, end, step = ticks.start - track.first_tick, ticks.stop - track.first_tick, ticks.step
    poses, reasons = track.poses_flat, track.rows_flat[first * len(ROW) + _REASON : end * len(ROW) : len(ROW)]
    found: list[int] = []
    before = -1
    for i, reason in enumerate(reasons):
        if i % step == 0 or (reason != before and reason not in _USUAL):
            at = (first + i) * AXES
            found += (round(poses[at]), round(poses[at + 1]), reason)
        before = reason
    return found
