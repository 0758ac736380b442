"""Runs a fleet and writes its summary, its table and its picture."""

import time
from collections.abc import Callable, Sequence
from pathlib import Path

from host_sim.base.errors import counted
from host_sim.base.files import run_folder, write_bytes
from host_sim.base.terminal import ProgressLine
from host_sim.cli.outputs import FLEET_PICTURE, SUMMARY, keep_earlier, print_result
from host_sim.cli.run_options import FLEET_TABLE, RunOptions
from host_sim.recording.fleet_summary import summarize_fleet, table
from host_sim.recording.summary import Summary
from host_sim.report.fleet_picture import write_fleet_picture
from host_sim.sim.fleet import FleetResult, run_fleet, shared_world
from host_sim.sim.run_config import RunConfig
from host_sim.world.geometry import SimParams

_WHERE = {"one": "all in one world", "own": "each in its own world", "hall": "all in one hall"}


def run_fleet_command(options: RunOptions) -> Summary:
    """Runs a fleet and writes its files to the folder `options.out`.

    Raises:
        UsageError: There is no such world; nothing was changed.
        OctetError: The run failed.
    """
    config, line = options, ProgressLine(shown=options.verbose)
    results: list[FleetResult] = []
    run = run_fleet(config, _progress_shown(line, config, results))
    with run_folder(options.out), line:
        if options.verbose:
            what = f"{counted(config.robots, 'robot')}, {_WHERE[config.worlds]}, profile {config.profile}"
            print(f"fleet     {what}, seeds from {config.seed}")
        began = time.monotonic()
        for result in run:
            results.append(result)  # noqa: PERF402 - the progress reads it meanwhile
        line.clear()
        summary = summarize_fleet(config, results, SimParams.tick_s, time.monotonic() - began)
        keep_earlier(options)
        write_bytes(options.out / FLEET_TABLE, table(results).encode())
        _draw(options.out / FLEET_PICTURE, config, results)
        summary.write(options.out / SUMMARY)
    print_result(options, summary, [options.out / name for name in (FLEET_PICTURE, FLEET_TABLE, SUMMARY)])
    return summary


def _progress_shown(
    line: ProgressLine, config: RunOptions, results: Sequence[FleetResult]
) -> Callable[[int], object]:
    """Returns a function that shows a fleet's progress, given the ticks of all its robots."""
    planned, began = config.robots * config.environments, time.monotonic()

    def show(ticks: int) -> None:
        if line.is_due():
            speed = ticks * SimParams.tick_s / (time.monotonic() - began)
            line.show(f"{len(results)} of {planned} environments   {speed:.0f} x real time")

    return show


def _draw(path: Path, config: RunConfig, results: Sequence[FleetResult]) -> None:
    if config.worlds == "own":
        write_fleet_picture(path, results, config.chosen_world.params)
        return
    layout, params = shared_world(config, config.environments)
    eaten = next(result.eaten for result in results if result.environment == config.environments)
    write_fleet_picture(path, results, params, (layout, eaten))
