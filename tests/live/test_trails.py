"""The trails in the messages to pages."""

from host_sim.live.trails import points
from host_sim.recording.trajectory import ROW, RobotTrack

FIRST = 100


def track_of(*reasons: int) -> RobotTrack:
    """A robot that drives 10 mm a tick along x; its first ticks are no longer retained."""
    track = RobotTrack(1, first_tick=FIRST)
    for i, reason in enumerate(reasons):
        track.poses_flat.extend((10.0 * i + 0.4, 7.0, 0.0))
        track.rows_flat.extend(reason if name == "reason" else 99 for name in ROW)
    return track


def test_each_step_is_a_place_and_a_reason():
    assert points(track_of(1, 1, 1, 1, 1), range(FIRST, FIRST + 5, 2)) == [0, 7, 1, 20, 7, 1, 40, 7, 1]


def test_no_reason_is_left_out_between_two_steps():
    assert points(track_of(1, 1, 5, 1, 1, 1), range(FIRST, FIRST + 6, 4)) == [0, 7, 1, 20, 7, 5, 30, 7, 1, 40, 7, 1]


def test_it_is_of_the_ticks_that_are_asked_for():
    assert points(track_of(1, 1, 2, 2, 1), range(FIRST + 1, FIRST + 4)) == [10, 7, 1, 20, 7, 2, 30, 7, 2]
    assert points(track_of(1, 1), range(FIRST + 2, FIRST + 2)) == []
