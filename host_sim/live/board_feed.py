"""The messages to a board: those of a page, and the people, each robot's learning curve, and how to join."""

from dataclasses import dataclass, field
from typing import Any

from host_sim.live.curves import NAMES, Curves
from host_sim.live.feed import PageFeed, as_json
from host_sim.live.listener import Listener
from host_sim.live.paced_run import PacedRun
from host_sim.live.seats import Seats


@dataclass
class Class:
    """The content of boards besides the run.

    Attributes:
        live: The run.
        listener: Provides the addresses that pupils open.
        seats: The assignment of robots to pages; None if the robots are shared.
        curves: Each robot's learning curve.
    """

    live: PacedRun
    listener: Listener
    seats: Seats | None
    curves: Curves = field(init=False)

    def __post_init__(self) -> None:
        self.curves = Curves(self.live)


@dataclass
class BoardFeed(PageFeed):
    """Tracks what one board has been sent."""

    of: Class = field(kw_only=True)
    _version: int = -1
    _samples: int = 0

    def _news(self, first: bool) -> dict[str, str]:
        """The parts of a page, and `board`.

        Its fields: `join`, in the first message, with the addresses to type or to open as `urls`, and the rows of the
        QR code of the first page's address as `modules`; `ended`, the environments before as [with all food eaten,
        all]; `robots`, each with `name` and `page`, whether one of its own is open, or null if the robots are
        everyone's; `curves`, the new samples: `anew`, whether earlier ones go, `ticks` since the start, and for each
        robot the samples of each of `NAMES`.
        """
        since, seats = self.live.episodes[self.live.started_over :], self.of.seats
        board: dict[str, Any] = {
            "ended": [sum(episode.finished for episode in since), len(since)],
            "robots": seats and [{"name": seat.name, "page": seat.pages > 0} for seat in seats.all],
            "curves": self._new_samples(),
        }
        if first:
            board["join"] = {"urls": self.of.listener.short_urls, "modules": self.of.listener.qr_modules}
        return super()._news(first) | {"board": as_json(board)}

    def _new_samples(self) -> dict[str, Any]:
        curves = self.of.curves
        anew = curves.version != self._version
        first = 0 if anew else self._samples
        self._version, self._samples = curves.version, len(curves.ticks)
        robots = [
            {name: [sample[i] for sample in samples[first:]] for i, name in enumerate(NAMES)}
            for samples in curves.robots
        ]
        return {"anew": anew, "ticks": [tick - curves.start for tick in curves.ticks[first:]], "robots": robots}
