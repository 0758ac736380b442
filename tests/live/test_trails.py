"""The trails in the messages to pages."""

from host_sim.live.feed import points
from host_sim.protocol.generated import ROW, Reason
from host_sim.recording.trajectory import RobotTrack

FIRST = 100
WANDER, LOOK, TRIAL = Reason.WANDER, Reason.LOOK_AROUND, Reason.TRIAL


def track_of(*reasons: int) -> RobotTrack:
    """A robot that drives 10 mm a tick along x; its first ticks are no longer retained."""
    track = RobotTrack(1, first_tick=FIRST)
    for i, reason in enumerate(reasons):
        track.poses_flat.extend((10.0 * i + 0.4, 7.0, 0.0))
        track.rows_flat.extend(reason if name == "reason" else 99 for name in ROW)
    return track


def test_each_tick_is_a_place_and_a_reason():
    assert points(track_of(WANDER, LOOK), range(FIRST, FIRST + 2)) == [0, 7, WANDER, 10, 7, LOOK]


def test_with_a_step_the_next_tick_counts_that_is_no_look_around():
    track = track_of(WANDER, WANDER, LOOK, WANDER, WANDER, WANDER)

    assert points(track, range(FIRST, FIRST + 6, 2)) == [0, 7, WANDER, 30, 7, WANDER, 50, 7, WANDER]


def test_no_trial_is_left_out_between_two_steps():
    track = track_of(WANDER, TRIAL, TRIAL, WANDER, TRIAL, WANDER)

    assert points(track, range(FIRST, FIRST + 6, 5)) == [0, 7, WANDER, 10, 7, TRIAL, 40, 7, TRIAL]


def test_it_is_of_the_ticks_that_are_asked_for():
    track = track_of(WANDER, TRIAL, TRIAL, LOOK)

    assert points(track, range(FIRST + 2, FIRST + 4)) == [20, 7, TRIAL, 30, 7, LOOK]
    assert points(track, range(FIRST + 4, FIRST + 4)) == []
