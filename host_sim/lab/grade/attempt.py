"""One attempt at an exercise: `python -m host_sim.lab.grade.attempt NUMBER SEED FILE [PAGE]`, a process with limits.

It prints the verdict as JSON, and writes PAGE if there is a wrong decision. The file is compiled, and drives robots
in several worlds. A judge (`native/judge.c`), linked in front of it, reports the first wrong decision.
"""

import json
import os
import resource
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path

from host_sim.base.errors import BrainError, OctetError
from host_sim.base.paths import BUILD
from host_sim.cli.own_source import log_words
from host_sim.client.frame_log import FrameLog
from host_sim.recording.resimulation import resimulate
from host_sim.recording.world_file import world_path, write_world
from host_sim.report.replay_page import write_page
from host_sim.sim.make import make, rehearse
from host_sim.sim.own_brain import OwnBrain, own_brain
from host_sim.sim.run_config import RunConfig
from host_sim.sim.world_record import WorldRecord

TITLES = {
    1: "One if",
    2: "The fixed table",
    3: "Count the sensors",
    4: "A trial",
    5: "Remember it",
    6: "Boredom",
    7: "Recheck and forget",
    8: "Beat adaptive",
}
"""The exercises: docs/exercises.md describes them."""

_JUDGE = BUILD / "host/host_sim/lab/grade/native/CMakeFiles/octet_judge.dir/judge.c.o"
_LAST_JUDGED = 7
_CPU_S, _FILE_BYTES, _FILES, _COMPILER_BYTES = 40, 20_000_000, 64, 4_000_000_000
_SETTINGS = {"turn_deg": 17, "trial_deg": 31, "step_mm": 15, "boredom_limit": 4, "boredom_min_deg": 100}
_RUNS = 8
_SEEDS = 2**31


@dataclass(frozen=True)
class Verdict:
    """The verdict on an attempt.

    Attributes:
        status: `pass`; `fail` for a wrong decision or a mistake that ended the run; `error` for a file that is no
            behaviour, as in the results of Exercism's test runners.
        message: What is wrong, in words; with `pass`, empty or a remark.
        tick: The tick of the first wrong decision; None if there is none.
    """

    status: str
    message: str = ""
    tick: int | None = None


@dataclass(frozen=True)
class Judged(OwnBrain):
    """A behaviour with the judge of an exercise."""

    @property
    def process(self) -> Path:
        """As in `OwnBrain`."""
        made = self.folder / f"judged-{_JUDGE.stat().st_mtime_ns}"
        if not made.exists():
            pupil, part = self.folder / f"pupil.{os.getpid()}.o", self.folder / f"judged.{os.getpid()}"
            names = [word for it in ("begin", "next") for word in ("--redefine-sym", f"own_{it}=pupil_{it}")]
            subprocess.run(["objcopy", *names, self.folder / "checked.o", pupil], check=True)
            self.link(part, "octet-robot", "checked", pupil, _JUDGE)
            pupil.unlink()
            part.replace(made)
        return made


@dataclass(frozen=True)
class _Attempt(RunConfig):
    """A run of the attempt with its judge."""

    @cached_property
    def own(self) -> OwnBrain | None:
        """As in `RunConfig`."""
        made = own_brain(Path(self.profile))
        return Judged(made.name, made.text, made.folder)


def _runs(profile: str, seed: int) -> Iterator[RunConfig]:
    """The runs that are judged: the second one has other parameters, and a world in which robots get stuck."""
    yield _Attempt(profile=profile, seed=seed, environments=3, limit_s=120.0)
    yield _Attempt(
        profile=profile, seed=seed + 1, environments=3, limit_s=120.0, settings=_SETTINGS, world="dead-ends"
    )


def attempt(number: int, seed: int, file: Path, page: Path | None = None) -> Verdict:
    """Judges the behaviour in a file.

    Args:
        number: The exercise.
        seed: Seed of the worlds, and of the robot's random numbers.
        file: The C file.
        page: A page to write of a run with a wrong decision, which opens at its tick; its log stands beside it.
    """
    os.environ["OCTET_EXERCISE"] = str(number)
    try:
        _compile(file)
        if number > _LAST_JUDGED:
            return _contest(file, seed)
        for config in _runs(os.fspath(file), seed):
            _drive(config, page)
    except BrainError as error:
        return Verdict("fail", str(error), error.tick)
    except OctetError as error:
        return Verdict("error", str(error))
    return Verdict("pass")


def _compile(file: Path) -> None:
    """Compiles it with little memory; the robot's process wants many addresses, most of which it never uses."""
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (_COMPILER_BYTES, hard))
    try:
        _ = own_brain(file)
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def _drive(config: RunConfig, page: Path | None = None) -> tuple[int, float]:
    """Runs it; returns the number of pieces of food eaten, and the robot time in s."""
    with ExitStack() as stack:
        log = FrameLog(page.with_suffix(".log")) if page else None
        if log:
            stack.callback(log.drop)
        simulation = stack.enter_context(make(config, log))
        try:
            episodes = list(simulation.run())
            simulation.clients[0].connection.status()
        except BrainError as mistake:
            if page and log and mistake.tick is not None:
                log.close()
                _write_page(page, simulation.record, config, mistake.tick)
            raise
    return sum(sum(it.eaten) for it in episodes), sum(it.robot_s for it in episodes)


def _write_page(page: Path, record: WorldRecord, config: RunConfig, tick: int) -> None:
    path = page.with_suffix(".log")
    write_world(record, world_path(path))
    run = resimulate(path)
    write_page(page, run.trajectory, run.title, shown=tick, log=log_words(path, config.profile))


def _contest(file: Path, seed: int) -> Verdict:
    """Compares it with the built-in behaviour adaptive: more food, or as much in less time."""
    rehearse(RunConfig(profile=os.fspath(file), seed=seed))
    food, time_s = {}, {}
    for profile, fast in ((os.fspath(file), True), ("adaptive", False)):
        configs = [RunConfig(profile=profile, fast=fast, seed=seed + it, environments=3) for it in range(_RUNS)]
        results = [_drive(config) for config in configs]
        food[fast], time_s[fast] = (sum(column) for column in zip(*results, strict=True))
    score = f"{food[True]} pieces of food in {time_s[True]:.0f} s; adaptive {food[False]} in {time_s[False]:.0f} s"
    is_better = (food[True], -time_s[True]) > (food[False], -time_s[False])
    return Verdict("pass" if is_better else "fail", score)


def main() -> int:
    """Returns 0; the verdict is on standard output."""
    number, seed, file, *page = sys.argv[1:]
    limits = {resource.RLIMIT_CPU: _CPU_S, resource.RLIMIT_FSIZE: _FILE_BYTES, resource.RLIMIT_NOFILE: _FILES}
    for limit, value in limits.items():
        resource.setrlimit(limit, (value, value))
    sys.stdout.write(json.dumps(asdict(attempt(int(number), int(seed), Path(file), *map(Path, page)))) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
