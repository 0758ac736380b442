"""What a run came to, as `summary.json` and as a few lines for people."""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from host_sim.atomic_file import write_bytes
from host_sim.client.robot_client import RobotClient
from host_sim.protocol.generated import PATTERNS, SIDES, Reason
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import EpisodeResult, RobotResult

_COUNTED = {"trials": Reason.TRIAL, "remembered_turns": Reason.REMEMBERED, "boredom_turns": Reason.BOREDOM}


@dataclass(frozen=True)
class Summary:
    """The whole of `summary.json`.

    Attributes:
        seed: Of environments and random turns.
        profile: What the robots behaved like, by name.
        bus: Where the robots were: none, fd, INTERFACE:CHANNEL, qemu, or an emulated board.
        environments: One entry each: finished, food_eaten, ticks, robot_s, and robots, with for each robot its node,
            food_eaten, trials, remembered_turns, boredom_turns, collisions and memory (the eight cells at its end).
        robots: One entry each: node, memory (the eight cells at the end), frames (sent, received, lost, refused) and
            faults, the robot's own fault counters.
        log_sha256: Of run.log.
        wall_s: How long it took.
        real_time_factor: Robot time by wall time.
    """

    seed: int
    profile: str
    bus: str
    environments: list[dict[str, Any]]
    robots: list[dict[str, Any]]
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
        several = len(self.robots) > 1
        memories = [f"memory    {self._whose(robot) if several else ''}{_cells(robot)}" for robot in self.robots]
        speed = f"speed     {self.real_time_factor:.0f} x real time on {self.bus}, {self.wall_s:.1f} s"
        return "\n".join([*memories, speed])

    def _whose(self, robot: dict[str, Any]) -> str:
        return f"robot {robot['node']}: "


def summarize(
    config: RunConfig,
    clients: Sequence[RobotClient],
    episodes: Sequence[EpisodeResult],
    log_sha256: str,
    wall_s: float,
) -> Summary:
    """Sums up a run that has ended.

    Args:
        config: What was asked for.
        clients: The robots, at its end.
        episodes: What happened in each environment.
        log_sha256: Of the log.
        wall_s: How long it took, s.
    """
    robot_s = sum(episode.robot_s for episode in episodes)
    return Summary(
        seed=config.seed,
        profile=config.profile,
        bus=clients[0].bus,
        environments=[_environment(episode) for episode in episodes],
        robots=[_robot(client) for client in clients],
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
    trials, known, bored = (episode.begun(reason) for reason in (Reason.TRIAL, Reason.REMEMBERED, Reason.BOREDOM))
    return (
        f"environment {number}   {end} in {episode.robot_s:.0f} s; {trials} trials, {known} remembered turns, "
        f"bored {bored} times"
    )


def frame_counts(client: RobotClient) -> dict[str, int]:
    """What became of a robot's frames: sent, received, lost, refused; what it says of its own side is in it."""
    faults, frames = client.faults, asdict(client.frames)
    frames["lost"] += faults.get("missed", 0)
    frames["refused"] += sum(faults.get(kind, 0) for kind in ("stale", "damaged", "foreign"))
    return frames


def _robot(client: RobotClient) -> dict[str, Any]:
    return {
        "node": client.node,
        "memory": list(client.memory),
        "frames": frame_counts(client),
        "faults": client.faults,
    }


def _environment(episode: EpisodeResult) -> dict[str, Any]:
    return {
        "finished": episode.finished,
        "food_eaten": sum(episode.eaten),
        "ticks": episode.ticks,
        "robot_s": episode.robot_s,
        "robots": [_deeds(robot) for robot in episode.robots],
    }


def _deeds(robot: RobotResult) -> dict[str, Any]:
    """What a robot did in an environment."""
    return {
        "node": robot.node,
        "food_eaten": robot.food_eaten,
        **{name: robot.begun.get(reason, 0) for name, reason in _COUNTED.items()},
        "collisions": robot.collisions,
        "memory": list(robot.memory),
    }


def _cells(robot: dict[str, Any]) -> str:
    cells = enumerate(robot["memory"])
    return "; ".join(f"{PATTERNS[pattern]}: {SIDES[side]}" for pattern, side in cells if side) or "nothing"
