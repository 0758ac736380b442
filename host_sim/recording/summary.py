"""What a run came to, as `summary.json` and as a few lines for people."""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from host_sim.atomic_file import write_bytes
from host_sim.cli.run_options import RunOptions
from host_sim.client.session import Session
from host_sim.sim.simulation import BOREDOM, REMEMBERED, TRIAL, EpisodeResult

SIDES = ("nothing", "left", "right")
"""What a cell holds, by its number."""


@dataclass(frozen=True)
class Summary:
    """The whole of `summary.json`.

    Attributes:
        seed: Of environments and random turns.
        profile: The robot's, by name.
        bus: Where the robot was: none, fd, INTERFACE:CHANNEL, qemu, or an emulated board.
        environments: One entry each: finished, food_eaten, ticks, robot_s, trials, remembered_turns, boredom_turns,
            collisions, memory (the eight cells at its end).
        memory: The eight cells at the end.
        frames: sent, received, lost, refused.
        faults: The robot's own fault counters.
        log_sha256: Of run.log.
        wall_s: How long it took.
        real_time_factor: Robot time by wall time.
    """

    seed: int
    profile: str
    bus: str
    environments: list[dict[str, Any]]
    memory: list[int]
    frames: dict[str, int]
    faults: dict[str, int]
    log_sha256: str
    wall_s: float
    real_time_factor: float

    def to_json(self) -> str:
        """The text of `summary.json`."""
        return json.dumps(asdict(self), indent=2) + "\n"

    def write(self, path: Path) -> None:
        """Writes `summary.json`.

        Raises:
            OctetError: The disk did not take it.
        """
        write_bytes(path, self.to_json().encode())

    def for_people(self) -> str:
        """A few lines."""
        learned = [f"{_pattern_words(p)}: {SIDES[cell]}" for p, cell in enumerate(self.memory) if cell]
        return (
            f"learned   {'; '.join(learned) if learned else 'nothing'}\n"
            f"speed     {self.real_time_factor:.0f} x real time on {self.bus}, {self.wall_s:.1f} s"
        )


def summarize(
    options: RunOptions, session: Session, episodes: Sequence[EpisodeResult], log_sha256: str, wall_s: float
) -> Summary:
    """Sums up a run that has ended.

    Args:
        options: What was asked for.
        session: The conversation, at its end.
        episodes: What happened in each environment.
        log_sha256: Of the log.
        wall_s: How long it took, s.
    """
    robot_s = sum(episode.robot_s for episode in episodes)
    faults, frames = session.faults, asdict(session.frames)
    frames["lost"] += faults.get("missed", 0)
    frames["refused"] += sum(faults.get(kind, 0) for kind in ("stale", "damaged", "foreign"))
    return Summary(
        seed=options.seed,
        profile=options.profile,
        bus=session.bus,
        environments=[_entry(episode) for episode in episodes],
        memory=list(session.memory),
        frames=frames,
        faults=faults,
        log_sha256=log_sha256,
        wall_s=round(wall_s, 3),
        real_time_factor=round(robot_s / wall_s, 2),
    )


def environment_line(number: int, episode: EpisodeResult) -> str:
    """One line for people about one environment.

    Args:
        number: 1 for the first.
        episode: What happened there.
    """
    end = "all food found" if episode.finished else f"{sum(episode.eaten)} of {len(episode.eaten)} food found"
    trials, known, bored = (episode.begun.get(reason, 0) for reason in (TRIAL, REMEMBERED, BOREDOM))
    return (
        f"environment {number}   {end} in {episode.robot_s:.0f} s; {trials} trials, {known} remembered turns, "
        f"bored {bored} times"
    )


def _entry(episode: EpisodeResult) -> dict[str, Any]:
    return {
        "finished": episode.finished,
        "food_eaten": sum(episode.eaten),
        "ticks": episode.ticks,
        "robot_s": episode.robot_s,
        "trials": episode.begun.get(TRIAL, 0),
        "remembered_turns": episode.begun.get(REMEMBERED, 0),
        "boredom_turns": episode.begun.get(BOREDOM, 0),
        "collisions": episode.collisions,
        "memory": list(episode.memory),
    }


def _pattern_words(pattern: int) -> str:
    names = ("front-right", "front", "front-left")
    return " + ".join(name for bit, name in enumerate(names) if pattern >> bit & 1)
