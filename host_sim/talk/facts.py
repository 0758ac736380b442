"""A robot's facts, computed from its log up to one tick. None of them is a guess."""

import math
import re
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

from host_sim.protocol.generated import AVOIDING, Reason, Side
from host_sim.recording.phrases import decimal, lesson_sentence, sentence, verdict
from host_sim.recording.state_types import Lesson
from host_sim.recording.trajectory import Trajectory, at
from host_sim.talk.eliza import Known
from host_sim.talk.log_index import LogIndex
from host_sim.talk.texts import POINT, Texts

_SECONDS = re.compile(rf"[0-9]{{1,9}}(?:{POINT}[0-9]{{1,3}})?")
_MOVES = tuple(reason for reason in Reason if reason != Reason.STOP)
_LAST = 3


class Rests(NamedTuple):
    """The evidence for a fact: ticks in order, and the cells and pieces of food concerned."""

    ticks: list[int]
    cells: list[int]
    food: list[int]


class RobotFacts:
    """The facts of one robot up to a tick. Each method in `FACTS` is one; their evidence is a `Rests`."""

    def __init__(self, trajectory: Trajectory, index: LogIndex, tick: int, texts: Texts, robot: int = 0) -> None:
        """Takes the facts from a run.

        Args:
            trajectory: The run.
            index: The other frames of the run's log.
            tick: The tick up to which the run is known.
            texts: The texts of the facts.
            robot: Index of the robot in the trajectory.
        """
        self._run, self._index, self._tick, self._texts, self._robot = trajectory, index, tick, texts, robot
        self._track, self._tick_ms = trajectory.tracks[robot], trajectory.params.tick_s * 1000
        self._now = self._run.at(tick, robot)

    def by_name(self) -> dict[str, Callable[[Sequence[str]], Known | None]]:
        """The facts by their names in scripts: the methods in `FACTS`, in capitals."""
        return {name.upper(): getattr(self, name) for name in FACTS}

    def learned(self, _: Sequence[str]) -> Known:
        """Contents of the cells."""
        return self._each_cell("learned")

    def sure(self, _: Sequence[str]) -> Known:
        """Number of uses of each cell."""
        return self._each_cell("sure")

    def cell(self, words: Sequence[str]) -> Known | None:
        """The turn for the pattern in a question, since when it is known, and its number of uses."""
        cell, now = self._texts.cell_in(words), self._now
        if not cell:
            return None
        since = "start" if now["learned"][cell] < 0 else "told" if now["by_hand"][cell] else "learned"
        said = self._texts.say(f"since_{since}", at=self._seconds(now["learned"][cell]))
        text = self._of_cell("cell" if now["memory"][cell] else "cell_none", cell, since=said)
        return self._known(text, [now["learned"][cell]], [cell])

    def why(self, words: Sequence[str]) -> Known | None:
        """The reason for an action: at a given time, or the last one."""
        return self._reason(words, self._begun(*_MOVES))

    def turn(self, words: Sequence[str]) -> Known | None:
        """The reason for a turn: at a given time, or the last one, to the side in a question if it names one."""
        return self._reason(words, self._begun(*AVOIDING, side=self._texts.side_in(words)))

    def bored(self, _: Sequence[str]) -> Known:
        """Number of times that it was bored, and the current count towards boredom."""
        count, limit = self._now["repeat_count"], self._run.boredom_limit
        return self._counted("bored", self._begun(Reason.BOREDOM), count=count, limit=limit)

    def food(self, _: Sequence[str]) -> Known:
        """The food eaten in this environment, and the time of the last meal."""
        eaten = self._now["eaten"]
        pieces = [piece for piece, gone in enumerate(eaten) if gone] or range(len(eaten))
        known = self._counted("food", self._until(self._track.meals), eaten=sum(eaten), pieces=len(eaten))
        return known._replace(evidence=known.evidence._replace(food=[*pieces]))

    def where(self, _: Sequence[str]) -> Known:
        """Its position, and the length of its path."""
        trail = self._track.trail(self._track.first_tick, self._tick + 1)
        places = [(round(x, 1), round(y, 1)) for x, y, _ in trail]
        steps = (math.dist(*both) for both in pairwise(places))
        way = self._metres(sum(step for step in steps if step < self._run.params.body_radius_mm), 1)
        x, y = self._metres(self._now["x"], 2), self._metres(self._now["y"], 2)
        return self._known(self._texts.say("where", x=x, y=y, way=way))

    def touched(self, _: Sequence[str]) -> Known:
        """Number of collisions."""
        bumps = self._track.column("bump")
        begun = (tick for tick, (before, bump) in enumerate(zip((0, *bumps), bumps, strict=False)) if bump > before)
        return self._counted("touched", self._until(tick + self._track.first_tick for tick in begun))

    def forgotten(self, _: Sequence[str]) -> Known:
        """Turns that it forgot by itself."""
        return self._noted("forgotten", [it for it in self._lessons() if not it["side"] and not it["by_hand"]])

    def told(self, _: Sequence[str]) -> Known:
        """Changes of its memory made by others."""
        return self._noted("told", [it for it in self._lessons() if it["by_hand"]])

    def tried(self, _: Sequence[str]) -> Known:
        """Number of trials, and the outcome of the last one if it has ended."""
        said = verdict(self._now["trial"], self._texts.words)
        return self._counted("tried", self._begun(Reason.TRIAL), verdict=said)

    def sees(self, _: Sequence[str]) -> Known:
        """Current sensor readings."""
        now, say = self._now, self._texts.say
        cell = now["feel"] >> 1 & 7
        food = say("sees_food", beacon=self._metres(now["beacon"], 2)) if now["beacon"] else say("sees_none")
        text = self._of_cell("sees" if cell else "sees_clear", cell, food=food)
        return self._known(text, cells=[cell] if cell else [], food=self._ahead() if now["beacon"] else [])

    def changed(self, _: Sequence[str]) -> Known:
        """Changes of the world and the bodies."""
        news = [it for it in self._run.news if it[0] <= self._tick and "could not happen:" not in it[1]]
        told = [self._texts.say("changed_item", at=self._seconds(tick), news=said) for tick, said in news[-_LAST:]]
        return self._counted("changed", [tick for tick, _ in news], last=" ".join(told))

    def behaviour(self, _: Sequence[str]) -> Known | None:
        """The behaviour with which it was started."""
        started = [it for it in self._index.starts if it[0] <= self._tick]
        return self._known(self._texts.say("behaviour", name=started[-1][1]), [started[-1][0]]) if started else None

    def bus(self, _: Sequence[str]) -> Known | None:
        """Contents of its last HEALTH report on the bus."""
        reports = [it for it in self._index.health if it[0] <= self._tick]
        if not reports:
            return None
        tick, said = reports[-1]
        return self._known(self._texts.say("bus", at=self._seconds(tick), **said), [tick])

    def _known(
        self, text: str, ticks: Iterable[int] = (), cells: Iterable[int] = (), food: Iterable[int] = ()
    ) -> Known:
        """A fact with its evidence; without ticks, the evidence is the current tick."""
        rests = sorted({tick for tick in ticks if tick >= 0}) or [self._tick]
        return Known(text.upper(), Rests(rests, sorted(set(cells)), [*food]))

    def _counted(self, name: str, ticks: Sequence[int], cells: Iterable[int] = (), **values: object) -> Known:
        """A fact about the number of events and the time of the last one."""
        if not ticks:
            return self._known(self._texts.say(f"{name}_none", **values))
        times, last = self._texts.times(len(ticks)), self._seconds(ticks[-1])
        return self._known(self._texts.say(name, **{"times": times, "at": last, **values}), ticks, cells)

    def _noted(self, name: str, lessons: Sequence[Lesson]) -> Known:
        said = [(self._seconds(it["tick"]), lesson_sentence(it, self._texts.words)) for it in lessons[-_LAST:]]
        last = " ".join(self._texts.say("why", at=when, sentence=it) for when, it in said)
        return self._counted(name, [it["tick"] for it in lessons], [it["cell"] for it in lessons], last=last)

    def _each_cell(self, name: str) -> Known:
        """A sentence for each cell that holds a turn."""
        held = [cell for cell, side in enumerate(self._now["memory"]) if cell and side]
        said = "; ".join(self._of_cell(name, cell) for cell in held)
        return self._known(said or self._texts.say(f"{name}_none"), self._now["learned"], held)

    def _of_cell(self, name: str, cell: int, **values: object) -> str:
        side, times = self._now["memory"][cell], self._texts.times(self._now["uses"][cell])
        return self._texts.say(name, **self._texts.of_cell(cell, side), times=times, **values)

    def _reason(self, words: Sequence[str], begun: Sequence[int]) -> Known | None:
        """The reason for the action at the time in a question; without a time, in the last of some ticks."""
        asked = _SECONDS.search(" ".join(words))
        tick = self._tick_at(asked[0]) if asked else max(begun, default=-1)
        if not self._track.first_tick <= tick <= self._tick:
            return None
        state = self._run.at(tick, self._robot)
        cells = [state["pattern"]] if state["reason"] in AVOIDING and state["pattern"] else []
        said = sentence(state, self._texts.words)
        return self._known(self._texts.say("why", at=self._seconds(tick), sentence=said), [tick], cells)

    def _tick_at(self, seconds: str) -> int:
        return math.floor(float(seconds.replace(POINT, ".")) * 1000 / self._tick_ms + 0.5)

    def _seconds(self, tick: int) -> str:
        return f"{decimal(tick * self._tick_ms / 1000, 2, self._texts.words)} s"

    def _metres(self, length_mm: float, digits: int) -> str:
        return decimal(length_mm / 1000, digits, self._texts.words)

    def _begun(self, *reasons: int, side: int = Side.NOTHING) -> list[int]:
        """The ticks so far in which actions with one of the reasons began, to a side if one is given."""
        names = ("action", "reason", "left_mm_s", "right_mm_s")
        actions, why, left, right = (self._track.column(name) for name in names)
        news = (tick for tick, both in enumerate(zip((-1, *actions), actions, strict=False)) if both[0] != both[1])
        wanted = (tick for tick in news if why[tick] in reasons)
        to_it = (tick for tick in wanted if not side or (left[tick] < right[tick]) == (side == Side.LEFT))
        return self._until(tick + self._track.first_tick for tick in to_it)

    def _until(self, ticks: Iterable[int]) -> list[int]:
        return [tick for tick in ticks if tick <= self._tick]

    def _lessons(self) -> list[Lesson]:
        """The lessons since the run was started over."""
        start = at(self._run.scenes, self._tick)["start_tick"]
        return [it for it in self._track.lessons if start <= it["tick"] <= self._tick]

    def _ahead(self) -> list[int]:
        """The piece of food nearest to the point at which the robot sees food."""
        now, scene = self._now, at(self._run.scenes, self._tick)
        x = now["x"] + now["beacon"] * math.cos(now["heading"] / 1000)
        y = now["y"] + now["beacon"] * math.sin(now["heading"] / 1000)
        far = [((fx - x) ** 2 + (fy - y) ** 2, piece) for piece, (fx, fy) in enumerate(scene["food"])]
        return [min(far)[1]] if far else []


FACTS = tuple(name for name, it in vars(RobotFacts).items() if callable(it) and name[0] != "_" and name != "by_name")
"""The names of all facts."""
