"""What a robot knows: facts that are computed from its log, up to one tick. None of them guesses."""

import re
from collections.abc import Callable, Iterable, Sequence

import numpy as np

from host_sim.protocol.generated import PATTERNS, ROW, SIDES, Reason, Side
from host_sim.recording.trajectory import Trajectory, at
from host_sim.talk.eliza import Known
from host_sim.talk.log_index import LogIndex
from host_sim.view.phrases import lesson_sentence, sentence, verdict
from host_sim.view.state_types import Lesson

POINT = "\u00b7"
"""The decimal point in a question: ELIZA takes a full stop for the end of a sentence."""

_SECONDS = re.compile(rf"\d{{1,9}}(?:{POINT}\d{{1,3}})?")
_TURNS = (Reason.REMEMBERED, Reason.TRIAL, Reason.BOREDOM)


class RobotFacts:
    """The facts of one robot up to a tick; the evidence of each is a tuple of the ticks on which it rests."""

    def __init__(self, trajectory: Trajectory, index: LogIndex, tick: int, robot: int = 0) -> None:
        """Takes a run.

        Args:
            trajectory: The run.
            index: The other frames of the run's log.
            tick: The tick that is asked about; what came later is not known.
            robot: Index of the robot in the trajectory.
        """
        self._run, self._index, self._tick, self._robot = trajectory, index, tick, robot
        self._track = trajectory.tracks[robot]
        self._tick_s = trajectory.params.tick_s

    def by_name(self) -> dict[str, Callable[[Sequence[str]], Known | None]]:
        """The facts by the names that scripts know them by: each method of `FACTS`, in capitals."""
        return {name.upper(): getattr(self, name) for name in FACTS}

    def learned(self, _: Sequence[str]) -> Known:
        """What the cells hold."""
        now = self._run.at(self._tick, self._robot)
        cells = [(PATTERNS[i], SIDES[side]) for i, side in enumerate(now["memory"]) if i and side]
        told = [f"{pattern} blocked, turn {side}" for pattern, side in cells]
        return self._known("; ".join(told) or "nothing yet", now["learned"])

    def cell(self, words: Sequence[str]) -> Known | None:
        """What it does at the pattern that is spoken of, since when, and how often it did."""
        cell = cell_in(words)
        now = self._run.at(self._tick, self._robot)
        side, since = now["memory"][cell], now["learned"][cell]
        if not cell:
            return None
        if not side:
            return self._known(f"{PATTERNS[cell]} blocked: I do not know yet what helps", [since])
        how = "told" if now["by_hand"][cell] else "learned"
        when = f"{how} at {self._seconds(since)}" if since >= 0 else "known from the start"
        used = f"used {_times(now['uses'][cell])} since"
        return self._known(f"{PATTERNS[cell]} blocked: I turn {SIDES[side]}, {when}, {used}", [since])

    def sure(self, _: Sequence[str]) -> Known:
        """How often it used what each cell holds."""
        now = self._run.at(self._tick, self._robot)
        cells = [(PATTERNS[i], now["uses"][i]) for i, side in enumerate(now["memory"]) if i and side]
        told = [f"{pattern} blocked, used {_times(uses)}" for pattern, uses in cells]
        return self._known("; ".join(told) or "of nothing: I have not learned anything yet", now["learned"])

    def why(self, words: Sequence[str]) -> Known | None:
        """Why it did what it did: at a time, or at its last move."""
        if said := _SECONDS.search(" ".join(words)):
            return self._reason(self._at(float(said[0].replace(POINT, "."))))
        moves = self._begun(*(reason for reason in Reason if reason != Reason.STOP))
        return self._reason(max(moves, default=None))

    def turn(self, words: Sequence[str]) -> Known | None:
        """Why it turned: at a time, or at its last turn, to the side that is spoken of."""
        if _SECONDS.search(" ".join(words)):
            return self.why(words)
        wanted = Side.LEFT if "LEFT" in words else Side.RIGHT if "RIGHT" in words else None
        turns = self._begun(*_TURNS)
        return self._reason(next((tick for tick in reversed(turns) if wanted in {None, self._side(tick)}), None))

    def bored(self, _: Sequence[str]) -> Known:
        """How often it was bored, and how near it is to it."""
        ticks = self._begun(Reason.BOREDOM)
        count = self._run.at(self._tick, self._robot)["repeat_count"]
        last = f", last at {self._seconds(ticks[-1])}" if ticks else ""
        now = f"now my repeat count is {count} of {self._run.boredom_limit}"
        return self._known(f"I was bored {_times(len(ticks))}{last}; {now}", ticks)

    def food(self, _: Sequence[str]) -> Known:
        """What was eaten of this environment's food, and what is left."""
        eaten = self._run.at(self._tick, self._robot)["eaten"]
        meals = self._until(self._track.meals)
        last = f"; my last meal was at {self._seconds(meals[-1])}" if meals else "; I have eaten nothing"
        return self._known(f"{sum(eaten)} of {len(eaten)} pieces of food are eaten here{last}", meals)

    def where(self, _: Sequence[str]) -> Known:
        """Where it is, and how long its way was."""
        now = self._run.at(self._tick, self._robot)
        poses = self._track.poses()[: self._tick + 1 - self._track.first_tick, :2]
        steps = ((poses[1:] - poses[:-1]) ** 2).sum(axis=1) ** 0.5
        way_m = steps[steps < self._run.params.body_radius_mm].sum() / 1000
        place = f"{now['x'] / 1000:.2f} m from the left wall and {now['y'] / 1000:.2f} m from the top wall"
        return self._known(f"{place}; I have come {way_m:.1f} m", [self._tick])

    def touched(self, _: Sequence[str]) -> Known:
        """How often it touched something."""
        bumps = self._track.column("bump")[: self._tick + 1 - self._track.first_tick]
        ticks = [t + self._track.first_tick for t in range(len(bumps)) if bumps[t] and not (t and bumps[t - 1])]
        return self._known(f"I have touched something {_times(len(ticks))}", ticks)

    def forgotten(self, _: Sequence[str]) -> Known:
        """What it forgot by itself."""
        lost = [it for it in self._lessons() if not it["side"] and not it["by_hand"]]
        said = [f"at {self._seconds(it['tick'])} {lesson_sentence(it)}" for it in lost[-3:]]
        return self._known(
            f"I have forgotten {_times(len(lost))} {' '.join(said)}".rstrip(), [it["tick"] for it in lost]
        )

    def told(self, _: Sequence[str]) -> Known:
        """What others wrote into its memory."""
        told = [it for it in self._lessons() if it["by_hand"]]
        said = " ".join(f"at {self._seconds(it['tick'])} {lesson_sentence(it)}" for it in told[-3:])
        return self._known(said or "nobody told me anything", [it["tick"] for it in told])

    def tried(self, _: Sequence[str]) -> Known:
        """How often it tried a random turn, and what came of the last one that ended."""
        ticks = self._begun(Reason.TRIAL)
        last = verdict(self._run.at(self._tick, self._robot)["trial"])
        return self._known(f"I have tried {_times(len(ticks))}. {last}".rstrip(), ticks)

    def sees(self, _: Sequence[str]) -> Known:
        """What its sensors say."""
        now = self._run.at(self._tick, self._robot)
        near = PATTERNS[now["feel"] >> 1 & 7] if now["feel"] & 0b01110 else "nothing"
        food = f"food {now['beacon'] / 1000:.2f} m ahead" if now["beacon"] else "no food"
        return self._known(f"{near} blocked, and {food}", [self._tick])

    def changed(self, _: Sequence[str]) -> Known:
        """What happened to the world and the body."""
        news = [(tick, said) for tick, said in self._run.news if tick <= self._tick]
        said = " ".join(f"at {self._seconds(tick)} {it}" for tick, it in news[-3:])
        return self._known(said or "nothing was changed, neither in the world nor in my body", [t for t, _ in news])

    def behaviour(self, _: Sequence[str]) -> Known | None:
        """Which behaviour it was started with."""
        start = next((it for it in reversed(self._index.starts) if it[0] <= self._tick), None)
        return self._known(f"my behaviour is {start[1]}", [start[0]]) if start else None

    def bus(self, _: Sequence[str]) -> Known | None:
        """What its last report on the bus says."""
        health = next((it for it in reversed(self._index.health) if it[0] <= self._tick), None)
        if health is None:
            return None
        tick, it = health
        return self._known(
            f"at {self._seconds(tick)}: {it['bus_offs']} times off the bus, {it['dropped']} frames dropped, "
            f"{it['tx_errors']} errors sending and {it['rx_errors']} receiving",
            [tick],
        )

    def _known(self, text: str, ticks: Iterable[int]) -> Known:
        """A fact that rests on ticks; where on none, on the one that is asked about."""
        rests = tuple(sorted({tick for tick in ticks if tick >= 0})) or (self._tick,)
        return Known(text.upper(), rests)

    def _seconds(self, tick: int) -> str:
        return f"{tick * self._tick_s:.2f} s"

    def _at(self, seconds: float) -> int | None:
        tick = round(seconds / self._tick_s)
        return tick if self._track.first_tick <= tick <= self._tick else None

    def _reason(self, tick: int | None) -> Known | None:
        if tick is None:
            return None
        return self._known(f"at {self._seconds(tick)}: {sentence(self._run.at(tick, self._robot))}", [tick])

    def _side(self, tick: int) -> int:
        row = dict(zip(ROW, self._track.row(tick), strict=True))
        return Side.LEFT if row["left_mm_s"] < row["right_mm_s"] else Side.RIGHT

    def _begun(self, *reasons: int) -> list[int]:
        """The ticks up to now in which actions with one of the reasons began."""
        news = np.diff(self._track.column("action"), prepend=np.int16(-1)) != 0
        ticks = np.flatnonzero(news & np.isin(self._track.column("reason"), reasons)) + self._track.first_tick
        return self._until(ticks.tolist())

    def _until(self, ticks: Iterable[int]) -> list[int]:
        return [tick for tick in ticks if tick <= self._tick]

    def _lessons(self) -> list[Lesson]:
        start = at(self._run.scenes, self._tick)["start_tick"]
        return [it for it in self._track.lessons if start <= it["tick"] <= self._tick]


FACTS = tuple(name for name, it in vars(RobotFacts).items() if callable(it) and name[0] != "_" and name != "by_name")
"""The names of all facts."""


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def cell_in(words: Sequence[str]) -> int:
    """The number of the pattern of front sensors that is spoken of; 0 if there is none."""
    said = " ".join(words).replace("-", " ")
    sides = {1: "FRONT RIGHT", 4: "FRONT LEFT"}
    cell = 0
    for bit, name in sides.items():
        if name in said or name.split()[1] in said.split():
            cell |= bit
            said = said.replace(name, "")
    if {"FRONT", "AHEAD"} & set(said.split()):
        cell |= 2
    return 7 if {"ALL", "EVERYTHING"} & set(words) else cell
