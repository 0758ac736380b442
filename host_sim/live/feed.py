"""The messages to one open page: only what has changed, only the latest state, and answers to what it asks."""

import json
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import FULL_SPEED, Question
from host_sim.protocol.generated import ROW, Reason
from host_sim.recording.phrases import news_of
from host_sim.recording.state import environment_scene, measures, states
from host_sim.recording.state_types import Lesson
from host_sim.recording.summary import frame_counts
from host_sim.recording.trajectory import AXES, RobotTrack, at
from host_sim.talk.conversation import NO_FACTS, Conversation, script_named, texts_of
from host_sim.talk.eliza import Facts
from host_sim.talk.facts import RobotFacts
from host_sim.talk.log_index import LogIndex

TRAIL_MAX = 3000
"""Maximum number of ticks in the trail of a page that joins late."""

_POINTS_MAX = 200
_NOTES_MAX = 8
_NEWS_MAX = 8
_ANSWERS_MAX = 8
_PLACES_MAX = 100
_REASON = ROW.index("reason")
_USUAL = (Reason.WANDER, Reason.LOOK_AROUND)


class Memo:
    """Parts of messages as JSON, created once for all pages that receive the same."""

    def __init__(self) -> None:
        self._now: tuple[int, int] = (-1, -1)
        self._parts: dict[object, str] = {}

    def part(self, now: tuple[int, int], key: object, make: Callable[[], object]) -> str:
        """A part of the current messages.

        Args:
            now: A version that changes whenever any part does.
            key: Further key on which the part depends.
            make: Creates the part.
        """
        if now != self._now:
            self._now = now
            self._parts.clear()
        if key not in self._parts:
            self._parts[key] = as_json(make())
        return self._parts[key]


@dataclass
class PageTalk:
    """The conversations of one page."""

    live: PacedRun
    _talks: dict[str, Conversation] = field(default_factory=dict)

    def answer(self, question: Question) -> dict[str, Any]:
        """An answer, as the page's TalkBox takes it.

        Returns:
            `who` and `sentence`, as they were asked; `said`: mark, text, ticks, cells and food, as in
            `host_sim.talk.conversation`; and `places`, where the robot was in those ticks of this environment, mm.
        """
        who = question.who
        if who not in self._talks:
            self._talks[who] = Conversation(script_named(who), NO_FACTS, texts_of(who))
        talk = self._talks[who]
        nodes = self.live.simulation.nodes
        robot = nodes.index(question.node) if question.node in nodes else 0
        run = self.live.recorder.trajectory
        talk.ask_about(self._facts(who, robot) if run.ticks else NO_FACTS)
        said = talk.answer(question.text)
        first = at(run.scenes, run.ticks - 1)["first_tick"] if run.ticks else 0
        ticks = [tick for tick in said.rests.ticks if tick >= max(first, run.first_tick)][-_PLACES_MAX:]
        places = [[round(part, 1) for part in run.tracks[robot].pose(tick)[:2]] for tick in ticks]
        answer = {"mark": said.mark, "text": said.text, **said.rests._asdict()}
        return {"who": who, "sentence": question.text, "said": answer, "places": places}

    def _facts(self, who: str, robot: int) -> Facts:
        run, simulation = self.live.recorder.trajectory, self.live.simulation
        run = replace(run, news=news_of(simulation.record))
        return RobotFacts(run, LogIndex(), run.ticks - 1, texts_of(who), robot).by_name()


@dataclass
class PageFeed:
    """Tracks what one page has been sent. Its size is bounded, however seldom the page is updated.

    Attributes:
        live: The run that the page watches.
        memo: Parts shared with other pages.
        notes: Messages to show on the page, about commands that could not be carried out.
    """

    live: PacedRun
    memo: Memo = field(default_factory=Memo)
    notes: deque[str] = field(default_factory=lambda: deque(maxlen=_NOTES_MAX))
    _answers: deque[dict[str, Any]] = field(default_factory=lambda: deque(maxlen=_ANSWERS_MAX))
    _talk: PageTalk = field(init=False)
    _layout: int = -1
    _start: int = -1
    _environments: int = 0
    _sent: tuple[int, int] = (-1, -1)
    _trail: int = 0
    _marked: int = 0
    _lessons: dict[int, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._talk = PageTalk(self.live)

    def ask(self, question: Question) -> None:
        """Answers a question with the next message."""
        self._answers.append(self._talk.answer(question))

    def next(self) -> str | None:
        """The message that brings the page up to date as JSON, or None if it is up to date.

        Its fields: `states`, one per robot, and if they are new `environment` and `measures`, as in
        recording/state_types.py, with `news`, the last changes of the world and the bodies, as [tick, sentence];
        `events`, for each robot those since the last message, as in report/replay_page.py; `trails`, for each robot
        the ticks since then as [x, y, reason, ...], thinned out if many; `lessons`, those of all robots; `play`, the
        state of the controls; `health`; `pins`, for each robot that has some, what is on them; `notes`, if there are
        any; `answers`, as of `PageTalk`, to what the page has asked since.
        """
        now = (self.live.simulation.tick, self.live.change)
        if now == self._sent and not self.notes:
            return None
        first = self._sent == (-1, -1)
        self._sent = now
        parts = self._news(first)
        shared = {
            "states": self._shared("states", lambda: states(self.live.simulation, self.live.recorder.histories)),
            "events": self._new_events(),
            "trails": self._new_trails(),
            "play": self._shared("play", lambda: play_state(self.live)),
            "health": self._shared("health", self._health),
            "pins": self._shared("pins", self._pins),
        }
        return "{" + ",".join(f'"{name}":{text}' for name, text in (parts | shared).items()) + "}"

    def _news(self, first: bool) -> dict[str, str]:
        """The parts that are this page's own, as JSON."""
        parts: dict[str, Any] = {}
        if first:
            limit = self.live.recorder.trajectory.boredom_limit
            parts["measures"] = measures(self.live.params, limit)
        if self.live.layout != self._layout:
            parts |= self._arena()
        parts["lessons"] = self._new_lessons()
        if self.notes:
            parts["notes"] = list(self.notes)
            self.notes.clear()
        if self._answers:
            parts["answers"] = list(self._answers)
            self._answers.clear()
        return {name: as_json(part) for name, part in parts.items()}

    def _shared(self, key: object, make: Callable[[], object]) -> str:
        return self.memo.part(self._sent, key, make)

    def _arena(self) -> dict[str, Any]:
        simulation = self.live.simulation
        self._layout = self.live.layout
        if len(simulation.record.begun) != self._environments:
            self._environments = len(simulation.record.begun)
            self._trail = max(self._first_tick(), simulation.tick - TRAIL_MAX)
        scene = environment_scene(simulation.record.begun, simulation.environments, simulation.arena)
        if scene["start_tick"] != self._start:
            self._start = scene["start_tick"]
            self._lessons.clear()
        self.live.recorder.trajectory.news = told = news_of(simulation.record)
        news = [it for it in told if it[0] >= scene["start_tick"]]
        return {"environment": scene, "news": news[-_NEWS_MAX:]}

    def _first_tick(self) -> int:
        """The first tick of the current environment."""
        return self.live.simulation.record.begun[-1].first_tick

    def _new_events(self) -> str:
        """The events of each robot since the last message as JSON."""
        trajectory, first = self.live.recorder.trajectory, self._marked
        self._marked = trajectory.ticks
        robots = range(len(trajectory.tracks))
        return self._shared(("events", first), lambda: [trajectory.events(robot, first) for robot in robots])

    def _new_trails(self) -> str:
        """The new part of each robot's trail as JSON; every tick of it if the environment has just begun.

        At full speed each message may be about another environment, so its first part has fewer points, too.
        """
        tracks = self.live.recorder.trajectory.tracks
        end = tracks[0].ticks
        first = max(self._trail, end - TRAIL_MAX, tracks[0].first_tick)
        whole = self._trail == self._first_tick() and self.live.speed != FULL_SPEED
        step = 1 if whole else 1 + (end - first) // _POINTS_MAX
        self._trail = end
        ticks = range(first, end, step)
        return self._shared(ticks, lambda: [points(track, ticks) for track in tracks])

    def _new_lessons(self) -> list[Lesson]:
        """The lessons since the last message, or since the run was started over; at most `_POINTS_MAX` per robot."""
        new = []
        for i, history in enumerate(self.live.recorder.histories):
            sent = self._lessons.get(i)
            if sent is None:
                sent = history.forgotten + sum(lesson["tick"] < self._start for lesson in history.lessons)
            new += history.lessons[max(sent - history.forgotten, 0) :][-_POINTS_MAX:]
            self._lessons[i] = history.forgotten + len(history.lessons)
        return new

    def _health(self) -> dict[str, int]:
        """The frame counters of all robots together, and those of the page."""
        counts = [frame_counts(client) for client in self.live.simulation.clients]
        return {
            **{name: sum(count[name] for count in counts) for name in ("sent", "lost", "refused")},
            "late": self.live.late,
            "orders_refused": self.live.refused,
        }

    def _pins(self) -> list[dict[str, Any]]:
        of_robots = (client.connection.pins for client in self.live.simulation.clients)
        return [figures() for figures in of_robots if figures is not None]


def points(track: RobotTrack, ticks: range) -> list[int]:
    """A part of a robot's trail.

    Args:
        track: The robot.
        ticks: Retained ticks. If they have a step, a look around between two small steps is left out, and a tick is
            added where any other action begins, so that no trial, remembered turn or meal is missing.

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


def play_state(live: PacedRun) -> dict[str, Any]:
    """The state of the controls."""
    return {
        "playing": live.playing,
        "speed": live.speed,
        "done": live.done,
        "rate": round(live.rate),
        "stays": live.stays,
        "ended": _ended(live),
    }


def _ended(live: PacedRun) -> dict[str, Any] | None:
    """The result of the environment that has just ended, and of all since the run was started over; else None."""
    since = live.episodes[live.started_over :]
    if live.ended_at is None or not since:
        return None
    last = since[-1]
    return {
        "number": live.simulation.record.begun[-1].number,
        "finished": last.finished,
        "eaten": sum(last.eaten),
        "food": len(last.eaten),
        "robot_s": last.robot_s,
        "environments": len(since),
        "environments_finished": sum(episode.finished for episode in since),
        "environments_robot_s": round(sum(episode.robot_s for episode in since), 3),
    }


def as_json(value: object) -> str:
    """A part of a message."""
    return json.dumps(value, separators=(",", ":"))
