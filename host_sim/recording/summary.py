"""The results of a run as `summary.json` and as a few lines of text."""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from host_sim.base.errors import counted
from host_sim.base.files import write_bytes
from host_sim.client.robot_client import RobotClient
from host_sim.protocol.generated import FEEL, PATTERNS, SIDES, Reason
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.sim.world_record import EpisodeResult, RobotResult, WorldRecord
from host_sim.world.changes import Change
from host_sim.world.memory_kinds import sides_of

_FAULTS_MAX = 255
_REFUSED = ("stale", "damaged", "foreign")
_COUNTED = {"trials": Reason.TRIAL, "remembered_turns": Reason.REMEMBERED, "boredom_turns": Reason.BOREDOM}


@dataclass(frozen=True)
class Summary:
    """The results of a run, of one robot or of thousands.

    Attributes:
        content: The contents of `summary.json`: see `summarize`, or `summarize_fleet` for a fleet.
        text: The same in a few lines for people.
        ending: The last line for people; empty for none.
    """

    content: dict[str, Any]
    text: str
    ending: str = ""

    def to_json(self) -> str:
        """The text of `summary.json`."""
        return json.dumps(self.content, indent=2) + "\n"

    def write(self, path: Path) -> None:
        """Writes `summary.json`.

        Raises:
            OctetError: The file cannot be written.
        """
        write_bytes(path, self.to_json().encode())


def summarize(
    config: RunConfig,
    simulation: Simulation,
    episodes: Sequence[EpisodeResult],
    log_sha256: str,
    wall_s: float,
) -> Summary:
    """Summarizes a run that has ended.

    - seed, profile, world, bus: as configured; the bus of an emulated robot is qemu, or its board.
    - own: Of a behaviour in a C file of its user: name, and sha256 of its source, in hexadecimal.
    - environments: One entry per environment: finished, food_eaten, ticks, robot_s, and robots, with each robot's
      node, food_eaten, trials, remembered_turns, boredom_turns, collisions, stuck_sensors (the number of them at the
      end) and memory (the eight cells at the end of the environment).
    - robots: One entry per robot: node, memory (the eight cells at the end), frames (sent, received, repeated,
      duplicate, lost, refused), faults (the robot's own fault counters), saturated (those at their limit of 255,
      whose true counts may be higher), round_trip_ms (mean time of an answer), real_time (ticks,
      speed of the clock, share of ticks without an answer, longest gap, share that began late by more than a tick,
      maximum delay of a tick; null in lockstep), line (outages and unsent frames).
    - changes: The scheduled changes: those made, those refused as impossible, and those missed because the
      run or their environment was too short.
    - incidents: Events that make the result doubtful, each with tick and node; empty for a sound run. If there are
      too many, the last entry of a robot is the number left out.
    - log_sha256: SHA-256 of the lines of the log without the data of BOOT, in hexadecimal.
    - wall_s: Duration of the run, s of wall-clock time.
    - real_time_factor: Robot time divided by wall-clock time.
    """
    clients = simulation.clients
    content: dict[str, Any] = {
        "seed": config.seed,
        "profile": config.profile,
        **source_of(config),
        "world": config.world,
        "bus": clients[0].connection.bus,
        "environments": [_environment(episode) for episode in episodes],
        "robots": [_robot(client) for client in clients],
        "changes": _changes(config, simulation.record),
        "incidents": [told for client in clients for told in _incidents(client)],
        "log_sha256": log_sha256,
        "wall_s": round(wall_s, 3),
        "real_time_factor": round(sum(episode.robot_s for episode in episodes) / wall_s, 2),
    }
    count, finished = max(len(episodes), config.environments), sum(episode.finished for episode in episodes)
    ending = "ALL DONE" if finished == count else f"done      {finished} of {count} environments finished"
    return Summary(content, text_of(content), ending)


def source_of(config: RunConfig) -> dict[str, dict[str, str]]:
    """The entry `own` of a summary; nothing for a built-in behaviour."""
    own = config.source
    return {"own": {"name": own.name, "sha256": own.sha256}} if own else {}


def text_of(content: dict[str, Any]) -> str:
    """A summary in a few lines of text: the robots' memories, the changes, and the speed."""
    robots, changed = content["robots"], content["changes"]
    whose = [f"robot {robot['node']}: " if len(robots) > 1 else "" for robot in robots]
    words = {"happened": "happened", "refused": "could not happen", "missed": "came after the end"}
    parts = [f"{len(changed[kind])} {text}" for kind, text in words.items() if changed[kind]]
    lines = [f"memory    {who}{_cells(robot)}" for who, robot in zip(whose, robots, strict=True)]
    lines += [f"changes   {', '.join(parts)}"] if parts else []
    lines += [f"link      {who}{told}" for who, robot in zip(whose, robots, strict=True) if (told := _link(robot))]
    speed = content["real_time_factor"]  # a run that is watched may be slower than real time
    factor = f"{speed:.0f}" if speed >= 10 else f"{speed:.1f}"  # noqa: PLR2004 - two digits are enough
    return "\n".join([*lines, f"speed     {factor} x real time on {content['bus']}, {content['wall_s']:.1f} s"])


def _incidents(client: RobotClient) -> list[str]:
    left_out = [f"(node {client.node}) {client.unlisted} more, not listed"] if client.unlisted else []
    return [*map(str, client.incidents), *left_out]


def _changes(config: RunConfig, record: WorldRecord) -> dict[str, list[str]]:
    refused = [refused.what for refused in record.refused]
    planned = (str(Change.parse(change)) for change in config.changes)
    missed = [change for change in planned if change not in {*record.happened, *refused}]
    return {"happened": record.happened, "refused": refused, "missed": missed}


def environment_line(number: int, episode: EpisodeResult) -> str:
    """The result of one environment in one line; environments are numbered from 1."""
    end = "all food eaten" if episode.finished else f"{sum(episode.eaten)} of {len(episode.eaten)} food eaten"
    end += ", every sensor stuck" if any(robot.stuck_sensors == len(FEEL) for robot in episode.robots) else ""
    trials, known, bored = (episode.begun(reason) for reason in (Reason.TRIAL, Reason.REMEMBERED, Reason.BOREDOM))
    return (
        f"environment {number}   {end} in {episode.robot_s:.0f} s; {counted(trials, 'trial')}, "
        f"{counted(known, 'remembered turn')}, bored {counted(bored, 'time')}"
    )


def frame_counts(client: RobotClient) -> dict[str, int]:
    """A robot's frame counters; refused includes the frames that the robot refused."""
    frames = asdict(client.frames)
    frames["refused"] += sum(client.faults.get(kind, 0) for kind in _REFUSED)
    return frames


def _robot(client: RobotClient) -> dict[str, Any]:
    mean_s = client.round_trip.mean_s
    return {
        "node": client.node,
        "memory": list(client.memory),
        "frames": frame_counts(client),
        "faults": client.faults,
        "saturated": [name for name, count in client.faults.items() if count == _FAULTS_MAX],
        "round_trip_ms": None if mean_s is None else round(mean_s * 1000, 3),
        "real_time": client.deadlines.summary(),
        "line": {"outages": client.connection.line.outages, "unsent": client.connection.line.unsent},
    }


def _link(robot: dict[str, Any]) -> str:
    """The faults between simulator and robot, in words; empty if there were none."""
    frames, faults = robot["frames"], robot["faults"]
    counts = {
        "repeated": frames["repeated"],
        "lost": frames["lost"],
        "refused": frames["refused"],
        "unsent": robot["line"]["unsent"],
    }
    parts = [f"{counted(count, 'frame')} {name}" for name, count in counts.items() if count]
    parts += [f"gone {counted(robot['line']['outages'], 'time')}"] if robot["line"]["outages"] else []
    more = dict.fromkeys(robot["saturated"], " or more")
    parts += [f"robot counted {name}: {count}{more.get(name, '')}" for name, count in faults.items() if count]
    slow = f"; an answer takes {robot['round_trip_ms']:.0f} ms" if parts and robot["round_trip_ms"] else ""
    return ", ".join(parts) + slow


def _environment(episode: EpisodeResult) -> dict[str, Any]:
    return {
        "finished": episode.finished,
        "food_eaten": sum(episode.eaten),
        "ticks": episode.ticks,
        "robot_s": episode.robot_s,
        "robots": [_robot_in_environment(robot) for robot in episode.robots],
    }


def _robot_in_environment(robot: RobotResult) -> dict[str, Any]:
    return {
        "node": robot.node,
        "food_eaten": robot.food_eaten,
        **{name: robot.begun.get(reason, 0) for name, reason in _COUNTED.items()},
        "collisions": robot.collisions,
        "stuck_sensors": robot.stuck_sensors,
        "memory": list(robot.memory),
    }


def _cells(robot: dict[str, Any]) -> str:
    cells = enumerate(sides_of(tuple(robot["memory"])))
    return "; ".join(f"{PATTERNS[pattern]}: {SIDES[side]}" for pattern, side in cells if side) or "nothing"
