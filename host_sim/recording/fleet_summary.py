"""The results of a fleet: a summary as JSON and as a few lines of text, and a table with a row for each robot."""

import statistics
from collections.abc import Sequence
from typing import Any

from host_sim.base.files import csv_text
from host_sim.protocol.generated import CELL_COUNT, PATTERNS, SIDES, Reason
from host_sim.recording.summary import Summary, source_of
from host_sim.sim.fleet import FleetResult
from host_sim.sim.run_config import RunConfig
from host_sim.world.memory_kinds import sides_of

COLUMNS = (
    "robot", "seed", "environment", "finished", "food_eaten", "ticks", "trials", "remembered_turns", "boredom_turns",
    "collisions", "memory", "x_mm", "y_mm", "heading_rad",
)  # fmt: skip
"""Columns of the table: `memory` is the eight bytes in hexadecimal, the pose is that at the environment's end."""


def summarize_fleet(config: RunConfig, results: Sequence[FleetResult], tick_s: float, wall_s: float) -> Summary:
    """Summarizes a fleet's run.

    - own: as in `summarize`.
    - seed, profile, worlds, robots: as configured; the seed is the first robot's, each other one has the next number.
    - environments: One entry per environment: number, robots_finished, robot_s (median robot time of the robots that
      finished, s; null if there are none), and learned (for each pattern, the number of robots that know nothing,
      left and right at its end).
    - robot_ticks: Number of ticks of all robots.
    - wall_s: Duration of the run, s of wall-clock time.
    - real_time_factor: Robot time of all robots divided by wall-clock time.
    """
    ticks = sum(result.ticks for result in results)
    environments = [
        _environment(number, [result for result in results if result.environment == number], tick_s)
        for number in range(1, config.environments + 1)
    ]
    content: dict[str, Any] = {
        **{name: getattr(config, name) for name in ("seed", "profile", "worlds", "robots")},
        **source_of(config),
        "environments": environments,
        "robot_ticks": ticks,
        "wall_s": round(wall_s, 3),
        "real_time_factor": round(ticks * tick_s / wall_s, 1),
    }
    known = environments[-1]["learned"]
    lines = [environment_line(environment, config.robots) for environment in environments]
    lines += [
        f"learned   {PATTERNS[pattern]}: " + ", ".join(f"{SIDES[side]} {known[pattern][side]}" for side in (1, 2, 0))
        for pattern in range(1, CELL_COUNT)
    ]
    speed = f"{content['real_time_factor']:.0f} x real time, all robots together, {wall_s:.1f} s"
    return Summary(content, "\n".join([*lines, f"speed     {speed}"]))


def environment_line(environment: dict[str, Any], robots: int) -> str:
    """The results of one environment of a summary in one line.

    >>> environment_line({"number": 2, "robots_finished": 812, "robot_s": 148.3}, robots=1000)
    'environment 2   812 of 1000 robots finished, half of them within 148 s'
    """
    half = "" if environment["robot_s"] is None else f", half of them within {environment['robot_s']:.0f} s"
    return f"environment {environment['number']}   {environment['robots_finished']} of {robots} robots finished{half}"


def table(results: Sequence[FleetResult]) -> str:
    """The table of all results, as CSV with a header line."""
    return csv_text([COLUMNS, *map(_row, sorted(results, key=lambda result: (result.robot, result.environment)))])


def learned(results: Sequence[FleetResult]) -> list[list[int]]:
    """For each pattern, the number of robots that know nothing, left and right for it at the end."""
    counts = [[0, 0, 0] for _ in range(CELL_COUNT)]
    for result in results:
        for pattern, side in enumerate(sides_of(result.memory)):
            counts[pattern][side] += 1
    return counts


def _environment(number: int, results: Sequence[FleetResult], tick_s: float) -> dict[str, Any]:
    ticks = [result.ticks for result in results if result.finished]
    return {
        "number": number,
        "robots_finished": len(ticks),
        "robot_s": round(statistics.median(ticks) * tick_s, 3) if ticks else None,
        "learned": learned(results),
    }


def _row(result: FleetResult) -> Sequence[object]:
    return (
        *(result.robot, result.seed, result.environment, int(result.finished), result.food_eaten, result.ticks),
        *(result.begun.get(reason, 0) for reason in (Reason.TRIAL, Reason.REMEMBERED, Reason.BOREDOM)),
        *(result.collisions, bytes(result.memory).hex()),
        *result.pose,
    )
