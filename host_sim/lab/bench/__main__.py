"""`tools/bench`: each figure beside a reference measured in the same run on the same machine."""

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING

from host_sim.base.errors import OctetError

if TYPE_CHECKING:
    from host_sim.lab.bench.figure import Figure

_LOOP_TICKS = 10_000_000


def main(arguments: Sequence[str] | None = None) -> int:
    """Measures and prints; the exit code is 1 if a figure misses its target."""
    options = _parse(arguments)
    try:
        return _measure(options)
    except OctetError as error:
        print(f"octet: {error}", file=sys.stderr)
        return error.exit_code


def judge(arguments: Sequence[str]) -> Sequence[str]:
    """The stages of tools/setup that a command line needs; exits if it is invalid or asks for help."""
    _parse(arguments)
    return ["tests", "web", "vcan"]


def _parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    description = "Measures speed, each figure beside a reference. The exit code is 1 if a figure misses its target."
    parser = argparse.ArgumentParser(prog="tools/bench", description=description)
    add = parser.add_argument
    add("--json", action="store_true", help="print JSON instead of a table")
    add("--equality", action="store_true", help="instead, compare long runs of all images with the host's")
    add(
        "--loops",
        action="store_true",
        help="instead, compare ten million ticks in C with those in Python and pymunk",
    )
    add("--peers", action="store_true", help="instead, measure beside Enki, from Debian's package libenki-dev")
    add("--vcan", action="store_true", help="instead, measure only on vcan0, which must exist, and print JSON")
    return parser.parse_args(arguments)


def _measure(options: argparse.Namespace) -> int:
    from host_sim.lab.bench.figure import table
    from host_sim.lab.bench.image_figures import compare_images
    from host_sim.lab.bench.lockstep_figures import measure_vcan
    from host_sim.lab.bench.peer_figures import peer_figures

    if options.equality:
        return 0 if compare_images() else 1
    if options.loops:
        return 0 if _compare_loops() else 1
    if options.vcan:
        print(json.dumps(measure_vcan()))
        return 0
    figures = peer_figures() if options.peers else _all_figures()
    print(json.dumps([asdict(figure) for figure in figures], indent=2) if options.json else table(figures))
    return 0 if all(figure.reached for figure in figures) else 1


def _all_figures() -> "list[Figure]":
    from host_sim.lab.bench.fleet_figures import fleet_figures, vector_figure
    from host_sim.lab.bench.image_figures import image_figures
    from host_sim.lab.bench.lockstep_figures import lockstep_figures
    from host_sim.lab.bench.page_figures import page_figures
    from host_sim.lab.bench.run_figures import memory_figure, start_figure

    return [
        start_figure(),
        memory_figure(),
        *fleet_figures(),
        vector_figure(),
        *lockstep_figures(),
        *image_figures(),
        *page_figures(),
    ]


def _compare_loops() -> bool:
    """Compares the tick loops and prints the results. Returns whether all are the same."""
    from host_sim.lab.bench.native_equality import compare_loops

    equal = True
    for seed, ticks, difference in compare_loops(_LOOP_TICKS):
        print(f"seed {seed}, {ticks} ticks: {difference or 'equal'}", flush=True)
        equal = equal and difference is None
    return equal


if __name__ == "__main__":
    sys.exit(main())
