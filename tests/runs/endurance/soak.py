"""A robot that runs for hours with faults every minute and a page open, and ten thousand starts and stops.

`.venv/bin/python -m tests.runs.endurance.soak 24 --starts 10000` prints memory, open files, log and counters for each
robot hour and for each tenth of the starts. The exit code is 1 if anything grows, is lost or is doubted. A sample is
among the tests.
"""

import argparse
import asyncio
import gc
import itertools
import os
import resource
import sys
import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import Incident
from host_sim.live.feed import PageFeed
from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import FULL_SPEED
from host_sim.protocol.generated import PARAMETERS
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig

FAULTS = (
    *("drop:0.05%", "duplicate:0.05%", "reorder:0.02%:2", "delay:0.05%:0-300ms", "corrupt:0.05%", "truncate:0.05%"),
    "flood:0.5%:50",
)
"""In a minute, 6,000 frames: three of each kind, and thirty bursts of foreign frames."""

FORGED = "in the robot's name"
"""One in some hundred thousand random frames looks like the robot's: that is noticed, and does no harm."""

TICKS_PER_HOUR = 180_000


class Growth(NamedTuple):
    """How much more there may be: memory in MB, and pieces of it that Python holds."""

    memory_mb: float
    pieces: int


UNTIL_CUT = Growth(60.0, 80_000)
"""Until a trajectory is first cut it grows to half a million ticks, 30 MB; what cuts it is loaded then."""

AFTER_CUT = Growth(10.0, 20_000)
"""One that was just cut is 4 MB smaller than one that is about to be."""

KEPT_OF_AN_ENVIRONMENT = 20
"""Pieces: its result, which the end of the run tells. Eight were counted; an incident now and then has its own."""

OF_STARTS = Growth(12.0, 2_000)
"""Since the first tenth. What a start leaves behind is fully collected before it is counted; the heap's gaps vary."""

WARM_STARTS = 10
"""At least so many come first: after them, everything is loaded that a start needs."""

_PAGE_EVERY = 50
_PAGE_BYTES = os.sysconf("SC_PAGE_SIZE")


@dataclass(frozen=True)
class Vitals:
    """What must not grow: memory in MB and as Python's pieces of it, open files, threads and child processes."""

    memory_mb: float
    pieces: int
    files: int
    threads: int
    children: int

    @staticmethod
    def now() -> "Vitals":
        """Those of this process."""
        pages = int(Path("/proc/self/statm").read_text().split()[1])
        children = Path(f"/proc/self/task/{os.getpid()}/children").read_text().split()
        files = len(list(Path("/proc/self/fd").iterdir()))
        size_mb = pages * _PAGE_BYTES / 1e6
        return Vitals(size_mb, sys.getallocatedblocks(), files, threading.active_count(), len(children))

    def has_grown(self, since: "Vitals", most: Growth) -> bool:
        """Whether there is more of anything than there was, or much more memory."""
        same = (self.files, self.threads, self.children) == (since.files, since.threads, since.children)
        is_larger = self.memory_mb > since.memory_mb + most.memory_mb or self.pieces > since.pieces + most.pieces
        return not same or is_larger

    def __str__(self) -> str:
        counts = f"{self.files} files, {self.threads} threads, {self.children} children"
        return f"{self.memory_mb:.1f} MB, {self.pieces} pieces, {counts}"


async def _with_page(run: PacedRun, ticks: int) -> int:
    """Plays a run to a tick, with a page that is updated all the while; the size of its largest message."""
    player, feed, largest = asyncio.create_task(run.play()), PageFeed(run), 0
    while not player.done() and run.simulation.tick < ticks:
        largest = max(largest, len(feed.next() or ""))
        for _ in range(_PAGE_EVERY):
            await asyncio.sleep(0)
    if player.done():
        await player
    player.cancel()
    return largest


def hours(count: float, step: float, folder: Path) -> Iterator[tuple[str, bool]]:
    """A run of so many robot hours; what there is to say after each step, and whether all is well."""
    log = FrameLog(folder / "run.log")
    config = RunConfig(environments=1000, faults=FAULTS, profile="adaptive")
    with make(config, log) as simulation:
        recorder = RunRecorder.of(simulation, PARAMETERS["boredom_limit"].default)
        run = PacedRun(simulation, recorder, lambda _: None, speed=FULL_SPEED, stays=False)
        run.begin()
        asyncio.run(_with_page(run, TICKS_PER_HOUR // 100))
        (client,) = simulation.clients
        first, most, size, ended = Vitals.now(), UNTIL_CUT, 0, 0
        for number in range(1, round(count / step) + 1):
            page = asyncio.run(_with_page(run, round(number * step * TICKS_PER_HOUR)))
            log.flush()
            before, size = size, sum(path.stat().st_size for path in folder.iterdir())
            frames, vitals = client.frames, Vitals.now()
            said = (
                f"{number * step:7.2f} h  {vitals}; log {(size - before) / 1e6:.1f} MB more; page {page} bytes; "
                f"{frames.repeated} repeated, {frames.refused} refused, {frames.lost} lost; "
                f"{len(run.episodes)} environments; {len(client.incidents)} incidents{_last(client.incidents)}"
            )
            doubted = any(FORGED not in incident.text for incident in client.incidents)
            kept = KEPT_OF_AN_ENVIRONMENT * (len(run.episodes) - ended)
            may = Growth(most.memory_mb, most.pieces + kept)
            yield said, not (vitals.has_grown(first, may) or frames.lost or doubted)
            if most == UNTIL_CUT and recorder.trajectory.first_tick:
                first, most, ended = vitals, AFTER_CUT, len(run.episodes)
        stop(client)
    log.close()


def _last(incidents: Sequence[Incident]) -> str:
    return f", last {incidents[-1]}" if incidents else ""


def starts(count: int) -> Iterator[tuple[str, bool]]:
    """Starts and stops: one in ten with a robot in a process of its own.

    An arena and its physics refer to each other: Python frees them not at once but when it looks for such rings,
    which it does the less often the more other things there are. Without looking, ten thousand starts level at 12 MB.
    """
    first, warm = Vitals.now(), max(WARM_STARTS, count // 10)
    for number in range(1, count + 1):
        config = RunConfig(environments=1, limit_s=0.1, seed=number, bus="fd" if number % 10 == 0 else "none")
        with make(config) as simulation:
            for _ in simulation.run():
                pass
            stop(simulation.clients[0])
        if number == warm:
            gc.collect()
            first = Vitals.now()
        if number % max(count // 10, 1) == 0:
            gc.collect()
            vitals = Vitals.now()
            yield f"{number:7} starts  {vitals}", not vitals.has_grown(first, OF_STARTS)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("hours", type=float)
    parser.add_argument(
        "--step", type=float, default=1.0, metavar="HOURS", help="of each line (default: %(default)s)"
    )
    parser.add_argument("--starts", type=int, default=0)
    arguments = parser.parse_args()
    wrong = 0
    with TemporaryDirectory() as folder:
        steps = hours(arguments.hours, arguments.step, Path(folder))
        for said, is_well in itertools.chain(steps, starts(arguments.starts)):
            sys.stdout.write(f"{said}{'' if is_well else '  WRONG'}\n")
            sys.stdout.flush()
            wrong += not is_well
    peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
    sys.stdout.write(f"{wrong} wrong; {peak_mb:.0f} MB of memory at most\n")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
