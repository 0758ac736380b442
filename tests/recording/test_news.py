"""What changed in a run, in plain sentences."""

import pytest

from host_sim.protocol.words import BODY_FAULTS
from host_sim.recording.phrases import body_sentence, news_of
from host_sim.sim.world_record import Edited, Refused, WorldRecord
from host_sim.world.edits import Edit
from host_sim.world.geometry import Plant

PLANT = Plant((500.0, 500.0), 80.0)


def record(*edits: Edited, robots: int = 1) -> WorldRecord:
    return WorldRecord(1, 5, 30000, robots, edits=list(edits))


def test_news_are_what_changed_by_itself_and_not_what_a_hand_moved():
    edits = [
        Edited(5, Edit("add_bar", a=(1.0, 1.0), b=(90.0, 90.0))),
        Edited(6, Edit("plant", at=PLANT.at, radius=PLANT.radius_mm)),
        Edited(7, Edit("lift")),
    ]

    assert news_of(record(*edits)) == [(6, "A plant was put down.")]


def test_plants_that_grow_at_once_are_one_piece_of_news():
    assert news_of(
        record(Edited(6, Edit("grow_plant", 0, radius=90.0)), Edited(6, Edit("grow_plant", 1, radius=90.0)))
    ) == [(6, "A plant has grown.")]


def test_what_happens_to_all_robots_is_one_piece_of_news_and_else_the_robot_is_named():
    both = [Edited(6, Edit("body", what="mirror", robot=robot)) for robot in (0, 1)]
    one = Edited(9, Edit("body", what="swap-motors", robot=1))

    assert news_of(record(*both, one, robots=2)) == [
        (6, "The sensor ring was mounted the wrong way round."),
        (9, "Robot 2: The motor plugs were swapped."),
    ]


def test_what_could_not_happen_is_news_in_its_place():
    made = record(Edited(9, Edit("plant", at=PLANT.at, radius=PLANT.radius_mm)))
    made.refused.append(Refused(6, "grow@1s", "there is no plant"))

    assert [tick for tick, _ in news_of(made)] == [6, 9]
    assert news_of(made)[0] == (6, "grow@1s could not happen: there is no plant.")


@pytest.mark.parametrize(
    ("what", "sentence"),
    [
        ("stuck-on:front-left", "The front-left sensor is stuck: it always sees something."),
        ("stuck-off:front", "The front sensor is dead: it never sees anything."),
        ("noise:10/1000", "Each sensor is wrong in 10 of 1000 ticks."),
        ("weak-motor:left:60%", "The left motor turns at 60% of its speed."),
        ("odometer:left:-100%", "The left odometer counts -100% of its wheel's travel."),
        ("false-beacon:90", "The beacon shows food 90 mm ahead where there is none."),
        ("slack:3deg", "The gears have 3deg more slack."),
        ("repair", "The body was repaired."),
    ],
)
def test_a_fault_of_the_body_is_told_in_a_sentence(what, sentence):
    assert body_sentence(what) == sentence


def test_every_fault_has_a_sentence():
    details = {"stuck-on": ":front", "stuck-off": ":front", "noise": ":1/2", "false-beacon": ":9", "latency": ":1"}
    details |= dict.fromkeys(("weak-motor", "odometer"), ":left:50%")
    details |= {"lag": ":60ms", "slack": ":3deg", "slip": ":5%"}

    assert all(body_sentence(name + details.get(name, "")).endswith(".") for name in BODY_FAULTS)
