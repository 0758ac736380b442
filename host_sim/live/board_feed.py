"""The messages to a board: the people, each robot's learning curve, and the state of the run."""

import json
from collections import deque
from dataclasses import dataclass, field
from typing import Any

from host_sim.live.curves import NAMES, Curves
from host_sim.live.feed import play_state
from host_sim.live.listener import Listener
from host_sim.live.paced_run import PacedRun
from host_sim.live.seats import Seats
from host_sim.protocol.memory_kinds import sides_of

_NOTES_MAX = 8


@dataclass
class BoardFeed:
    """Tracks what one board has been sent.

    Attributes:
        live: The run.
        curves: How each robot learns.
        seats: Who has which robot; None if the robots are everyone's.
        listener: Has the address that pupils open.
        notes: Messages to show, about commands that could not be carried out.
    """

    live: PacedRun
    curves: Curves
    seats: Seats | None
    listener: Listener
    notes: deque[str] = field(default_factory=lambda: deque(maxlen=_NOTES_MAX))
    _version: int = -1
    _samples: int = 0

    def next(self) -> str:
        """The next message as JSON.

        Its fields: `join`, in the first message, with the addresses of the page as `urls` and the rows of the QR code
        of the first as `modules`; `tick_ms`; `clock_ms`, robot time since the run was started over; `environment` as
        [number, of]; `ended`, the environments before as [with all food found, all]; `food` as [eaten, of]; `seed`;
        `play`, as the page is sent it; `robots`, each with `node`, `name`, `page`, whether one of its own is open,
        and the turns that it knows as `sides`; `notes`, if any.
        `curves` has the new samples: `anew`, whether earlier ones go, `ticks` since the start, and for each robot the
        samples of each of `NAMES`.
        """
        message = self._state() | {"curves": self._new_samples()}
        if self._version < 0:
            message["join"] = {"urls": self.listener.urls, "modules": self.listener.qr_modules}
        self._version = self.curves.version
        if self.notes:
            message["notes"] = list(self.notes)
            self.notes.clear()
        return json.dumps(message, separators=(",", ":"))

    def _state(self) -> dict[str, Any]:
        simulation = self.live.simulation
        tick_ms, eaten = simulation.params.tick_s * 1000, simulation.arena.food.eaten
        since = self.live.episodes[self.live.started_over :]
        return {
            "tick_ms": tick_ms,
            "clock_ms": round((simulation.tick - self.live.start_tick) * tick_ms),
            "environment": [simulation.record.begun[-1].number, simulation.environments],
            "ended": [sum(episode.finished for episode in since), len(since)],
            "food": [sum(eaten), len(eaten)],
            "seed": simulation.seed,
            "play": play_state(self.live),
            "robots": [self._robot(i) for i in range(len(simulation.clients))],
        }

    def _robot(self, index: int) -> dict[str, Any]:
        client = self.live.simulation.clients[index]
        seat = self.seats.all[index] if self.seats else None
        return {
            "node": client.node,
            "name": seat.name if seat else "",
            "page": bool(seat and seat.pages),
            "sides": list(sides_of(client.memory)),
        }

    def _new_samples(self) -> dict[str, Any]:
        curves = self.curves
        anew = curves.version != self._version
        first = 0 if anew else self._samples
        self._samples = len(curves.ticks)
        robots = [
            {name: [sample[i] for sample in samples[first:]] for i, name in enumerate(NAMES)}
            for samples in curves.robots
        ]
        return {"anew": anew, "ticks": [tick - curves.start for tick in curves.ticks[first:]], "robots": robots}
