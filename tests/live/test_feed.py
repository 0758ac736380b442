"""What pages are told of a run: what is new and only that, trails, each lesson once, and what robots answer."""

import json
from typing import Any

import pytest

from host_sim.client.commands import write_cells
from host_sim.live.feed import PageFeed, PageTalk, points
from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import FULL_SPEED, NewSeed, Question, page_command_from
from host_sim.protocol.generated import ROW, Reason
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.trajectory import RobotTrack
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.world.edits import Edit
from tests.live.support import order, play


def test_page_feed_sends_only_what_is_new(live):
    run = live(speed=FULL_SPEED)
    feed = PageFeed(run)
    assert feed.next() is not None
    assert feed.next() is None
    run.simulation.step()
    assert "environment" not in json.loads(feed.next())


def test_page_feed_shows_a_pushed_crate():
    blind = tuple(f"stuck-off:{sensor}@0s" for sensor in ("front", "front-left", "front-right"))
    with make(RunConfig(environments=1, world="crates", changes=blind)) as simulation:
        run = PacedRun(simulation, RunRecorder.of(simulation, boredom_limit=10), lambda _: None, speed=FULL_SPEED)
        run.begin()
        feed = PageFeed(run)
        feed.next()
        play(run, lambda: any(edit.do == "push_bar" for _, edit in simulation.record.edits))

    last = simulation.record.edits[-1].edit
    bars = {bar_id: ends for bar_id, *ends in json.loads(feed.next())["environment"]["bars"]}
    assert bars[last.id] == [*last.a, *last.b]


def test_message_stays_below_50_kb_after_20000_unread_ticks(live):
    run = live(speed=FULL_SPEED)
    feed = PageFeed(run)
    while run.simulation.tick < 20_000:
        if run.simulation.over:
            run.simulation.enter(2)
        run.simulation.step()
    assert len(feed.next()) < 50_000


def test_page_feed_sends_each_lesson_once_though_old_ones_are_forgotten():
    with make(RunConfig(environments=1)) as simulation:
        run = PacedRun(simulation, RunRecorder.of(simulation, boredom_limit=10), lambda _: None)
        run.begin()
        feed, (history,), (client,) = PageFeed(run), run.recorder.histories, simulation.clients

        def write(cell: int, side: int) -> None:
            write_cells(client, {cell: side})
            history.relearn(simulation.tick, client.memory)

        write(3, 1)
        write(3, 2)
        write(5, 1)
        assert len(json.loads(feed.next())["lessons"]) == 3

        simulation.step()
        history.forget_lessons(simulation.tick)
        write(6, 2)

        assert history.forgotten == 1
        assert [lesson["cell"] for lesson in json.loads(feed.next())["lessons"]] == [6]


def test_page_feed_sends_each_event_of_each_robot_once(live):
    run = live(robots=2, speed=FULL_SPEED)
    feed, late = PageFeed(run), PageFeed(run)
    trajectory = run.recorder.trajectory
    told: list[list[list[Any]]] = [[], []]
    for step in range(1500):
        if run.simulation.over:
            run.simulation.enter(2)
        if step == 200:
            run.simulation.edit(Edit("body", what="stuck-on:front", robot=1))
        run.layout += step == 200
        run.simulation.step()
        for robot, events in enumerate(json.loads(feed.next())["events"]):
            told[robot] += events

    assert told == json.loads(late.next())["events"] == [list(map(list, trajectory.events(i))) for i in (0, 1)]
    assert {kind for _, kind in told[0] + told[1]} >= {"environment", "change", "trial", "lesson", "eat"}


def test_starting_over_in_the_first_environment_is_an_event(live):
    run = live()
    run.simulation.step(1)
    order(run, NewSeed(7))
    run.simulation.step(1)

    kinds = [kind for _, kind in run.recorder.trajectory.events()]
    assert kinds.count("environment") == 2


FIRST = 100
WANDER, LOOK, TRIAL = Reason.WANDER, Reason.LOOK_AROUND, Reason.TRIAL


def track_of(*reasons: int) -> RobotTrack:
    """A robot that drives 10 mm a tick along x; its first ticks are no longer retained."""
    track = RobotTrack(1, first_tick=FIRST)
    for i, reason in enumerate(reasons):
        track.poses_flat.extend((10.0 * i + 0.4, 7.0, 0.0))
        track.rows_flat.extend(reason if name == "reason" else 99 for name in ROW)
    return track


def test_trail_has_position_and_reason_of_each_tick():
    assert points(track_of(WANDER, LOOK), range(FIRST, FIRST + 2)) == [0, 7, WANDER, 10, 7, LOOK]


def test_trail_with_a_step_skips_look_around_to_the_next_tick():
    track = track_of(WANDER, WANDER, LOOK, WANDER, WANDER, WANDER)

    assert points(track, range(FIRST, FIRST + 6, 2)) == [0, 7, WANDER, 30, 7, WANDER, 50, 7, WANDER]


def test_trail_with_a_step_keeps_trials_between_two_steps():
    track = track_of(WANDER, TRIAL, TRIAL, WANDER, TRIAL, WANDER)

    assert points(track, range(FIRST, FIRST + 6, 5)) == [0, 7, WANDER, 10, 7, TRIAL, 40, 7, TRIAL]


def test_trail_covers_only_the_ticks_asked_for():
    track = track_of(WANDER, TRIAL, TRIAL, LOOK)

    assert points(track, range(FIRST + 2, FIRST + 4)) == [20, 7, TRIAL, 30, 7, LOOK]
    assert points(track, range(FIRST + 4, FIRST + 4)) == []


def test_robot_answers_in_words_alone_before_its_first_tick(live):
    assert PageTalk(live()).answer(Question("robot", "What have you learned?"))["said"]["mark"] == "words"


def test_answer_comes_from_the_robot_of_the_node_or_else_the_first(live):
    run = live(robots=2)
    for _ in range(20):
        run.simulation.step(1)
    talk = PageTalk(run)

    said = [talk.answer(Question("robot", "Where are you?", node)) for node in (1, 2, 31)]

    assert {it["said"]["mark"] for it in said} == {"log"}
    assert said[0]["said"]["text"] != said[1]["said"]["text"]
    assert said[0]["said"]["text"] == said[2]["said"]["text"]  # a robot that is not there: the first
    places = [[round(part, 1) for part in body.pose[:2]] for body in run.simulation.arena.bodies]
    assert [it["places"] for it in said[:2]] == [[places[0]], [places[1]]]


def test_answer_comes_with_the_next_message_and_only_once(live):
    run = live()
    run.simulation.step(1)
    feed = PageFeed(run)
    feed.ask(Question("eliza", "Hello"))

    assert feed.next().count('"answers"') == 1
    run.change += 1
    assert '"answers"' not in feed.next()


def test_question_in_a_message_is_parsed():
    asked = page_command_from('{"do": "ask", "who": "robot-de", "text": "Wo bist du?", "node": 2}')

    assert asked == Question("robot-de", "Wo bist du?", 2)


@pytest.mark.parametrize(
    "fields", ['"who": "../robot", "text": ""', '"who": "robot"', '"who": ["robot"], "text": "x"']
)
def test_question_without_known_speaker_or_text_is_refused(fields):
    with pytest.raises(ValueError, match="who must be one of"):
        page_command_from(f'{{"do": "ask", {fields}}}')
