"""The trails in the messages to pages: as many points as a page can tell apart."""

from host_sim.recording.trajectory import AXES, ROW, RobotTrack

_REASON = ROW.index("reason")


def points(track: RobotTrack, ticks: range) -> list[int]:
    """A part of a robot's trail.

    Args:
        track: The robot.
        ticks: Retained ticks. Between them, those in which the reason changes are added: none is left out.

    Returns:
        [x, y, reason, ...], x and y in mm.
    """
    first, end, step = ticks.start - track.first_tick, ticks.stop - track.first_tick, ticks.step
    poses, reasons = track.poses_flat, track.rows_flat[first * len(ROW) + _REASON : end * len(ROW) : len(ROW)]
    found: list[int] = []
    before = -1
    for i, reason in enumerate(reasons):
        if reason != before or i % step == 0:
            at = (first + i) * AXES
            found += (round(poses[at]), round(poses[at + 1]), reason)
            before = reason
    return found
