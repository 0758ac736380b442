"""Lockstep over a bus that loses, doubles, reorders, delays and damages frames: slower, and else the same run."""

import pytest

from host_sim.client.robot_client import RobotClient
from tests.client.support import connected, drives_in, run

TICKS = 250
BAD_BUS = ("drop:30%", "duplicate:10%", "reorder:10%", "delay:0-300ms")
FAULTS = {
    "a third is lost": ("drop:30%",),
    "everything comes twice": ("duplicate",),
    "frames overtake each other": ("reorder:30%:2",),
    "frames are late": ("delay:0-300ms",),
    "bits flip": ("corrupt:20%",),
    "two in three are damaged": ("corrupt:68%",),
    "frames end early": ("truncate:20%",),
    "others talk": ("flood:5%:20",),
    "one way only is bad": ("drop:50%/to",),
    "the other way only is bad": ("drop:50%/from",),
    "a cut": ("drop@200-230",),
    "all of it": (*BAD_BUS, "corrupt:5%", "truncate:5%", "flood:2%"),
}


def run_over(faults: tuple[str, ...], ticks: int, seed: int = 1) -> RobotClient:
    with connected(faults=faults, seed=seed) as client:
        run(client, ticks)
    return client


@pytest.fixture(scope="module")
def clean() -> RobotClient:
    return run_over((), TICKS)


def test_a_clean_run_repeats_nothing(clean):
    assert (clean.frames.repeated, clean.frames.duplicate, clean.frames.lost, clean.frames.refused) == (0, 0, 0, 0)
    assert clean.memory != (0,) * 8
    assert len(drives_in(clean.log.frames)) == TICKS


@pytest.mark.parametrize("faults", FAULTS.values(), ids=FAULTS)
@pytest.mark.parametrize("seed", [1, 2])
def test_the_drives_are_those_of_a_clean_run(clean, faults, seed):
    client = run_over(faults, TICKS, seed)

    assert drives_in(client.log.frames) == drives_in(clean.log.frames)
    assert (client.memory, client.incidents) == (clean.memory, [])


def test_what_was_repeated_is_counted(clean):
    client = run_over(("drop:30%",), TICKS)

    assert client.frames.repeated > TICKS / 3
    assert client.frames.sent < clean.frames.sent + 40
    assert client.frames.lost == 0


def test_what_came_twice_is_counted_and_not_recorded(clean):
    client = run_over(("duplicate",), TICKS)

    assert client.frames.duplicate > TICKS
    assert client.log.frames == clean.log.frames


SHORT = 30
FRAMES = 58
"""More frames than a run of `SHORT` ticks has in either direction."""


@pytest.mark.parametrize("way", ["to", "from"])
@pytest.mark.parametrize("fault", ["drop", "delay:300ms"])
def test_whichever_frame_is_hit_the_result_is_right_or_said_to_be_doubtful(way, fault):
    clean = run_over((), SHORT)

    for number in range(1, FRAMES):
        client = run_over((f"{fault}@{number}/{way}",), SHORT)

        assert drives_in(client.log.frames) == drives_in(clean.log.frames), number
        assert client.memory == clean.memory, number
    assert len(clean.log.frames) < FRAMES * 2


def test_a_robot_that_is_gone_ends_the_run_with_its_tick():
    with (
        connected(faults=("drop@100-/from",)) as client,
        pytest.raises(Exception, match="did not answer tick") as ended,
    ):
        run(client, TICKS)

    assert "within 5 s" in str(ended.value)


def test_a_slow_bus_is_waited_for_and_not_flooded():
    client = run_over(("delay:150ms",), 100)

    assert client.round_trip.mean_s == pytest.approx(0.3, rel=0.1)
    assert client.frames.repeated < 4 * 100
