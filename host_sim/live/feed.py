"""What one watching page is told: only what it does not know yet, and only the latest of it."""

import json
import time
from collections import deque
from dataclasses import asdict, dataclass, field
from typing import Any

from host_sim.live.paced_run import PacedRun
from host_sim.view.state import Lesson, State, environment_scene, measures, state

TRAIL_MAX = 3000
"""A page that joins late gets so many ticks of the trail."""

_POINTS_MAX = 200
_NOTES_MAX = 8


@dataclass
class PageFeed:
    """Knows what one page knows. However seldom it is asked, what it holds does not grow.

    Attributes:
        live: The run that the page watches.
        notes: What the page's person is to be told: orders that could not be obeyed.
    """

    live: PacedRun
    notes: deque[str] = field(default_factory=lambda: deque(maxlen=_NOTES_MAX))
    _layout: int = -1
    _environments: int = 0
    _told: tuple[int, int] = (-1, -1)
    _trail: int = 0
    _lessons: int = 0

    def next(self) -> str | None:
        """The message that brings the page up to date, or None if it is.

        Its fields: `state`, and if they are new `environment` and `measures`, as in scene.py; `trail`, the ticks
        since the last message as [x, y, reason, ...], thinned out if there are many; `lessons`, those since; `play`,
        what the controls show; `health`; `notes`, if there are any; `at`, the wall's time in ms since 1970.
        """
        now = (self.live.simulation.tick, self.live.change)
        if now == self._told and not self.notes:
            return None
        first = self._told == (-1, -1)
        self._told = now
        message: dict[str, Any] = {"measures": measures(self.live.params, self.live.boredom_limit)} if first else {}
        if self.live.layout != self._layout:
            message |= self._arena()
        message |= {
            "at": round(time.time() * 1000),
            "state": self._state(),
            "trail": self._new_trail(),
            "lessons": self._new_lessons(),
            "play": self._play(),
            "health": self._health(),
        }
        if self.notes:
            message["notes"] = list(self.notes)
            self.notes.clear()
        return json.dumps(message, separators=(",", ":"))

    def _arena(self) -> dict[str, Any]:
        simulation = self.live.simulation
        self._layout = self.live.layout
        if len(simulation.record.begun) != self._environments:
            self._environments = len(simulation.record.begun)
            self._trail = max(0, simulation.episode.ticks - TRAIL_MAX)
        scene = environment_scene(simulation.record.begun[-1], simulation.environments, simulation.arena)
        return {"environment": scene}

    def _state(self) -> State:
        simulation = self.live.simulation
        drive, senses = simulation.drive, simulation.senses
        return state(max(0, simulation.tick - 1), simulation.arena, senses, drive, self.live.history)

    def _new_trail(self) -> list[float]:
        trail = self.live.simulation.episode.trail
        first = max(self._trail, len(trail) - TRAIL_MAX)
        step = 1 + (len(trail) - first) // _POINTS_MAX if self._trail else 1
        points = trail[first::step]
        self._trail = len(trail)
        return [number for x, y, reason in points for number in (round(x), round(y), reason)]

    def _new_lessons(self) -> list[Lesson]:
        lessons = self.live.history.lessons[self._lessons :][-_POINTS_MAX:]
        self._lessons = len(self.live.history.lessons)
        return lessons

    def _play(self) -> dict[str, Any]:
        live = self.live
        return {
            "playing": live.playing,
            "speed": live.speed,
            "done": live.done,
            "rate": round(live.rate),
            "stays": live.stays,
        }

    def _health(self) -> dict[str, int]:
        session = self.live.simulation.session
        frames, faults = asdict(session.frames), session.faults
        return {
            "sent": frames["sent"],
            "lost": frames["lost"] + faults.get("missed", 0),
            "refused": frames["refused"] + sum(faults.get(kind, 0) for kind in ("stale", "damaged", "foreign")),
            "late": self.live.late,
            "orders_refused": self.live.refused,
        }
