"""`tools/bench`: each figure beside a reference measured in the same run on the same machine."""

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import asdict

from host_sim.base.errors import OctetError


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
    description = "Measures speed, each figure beside a reference. The exit code is 1 if a ratio misses its target."
    parser = argparse.ArgumentParser(prog="tools/bench", description=description)
    parser.add_argument("--json", action="store_true", help="print JSON instead of a table")
    parser.add_argument("--vcan", action="store_true", help="only on vcan0, which must exist; prints JSON")
    return parser.parse_args(arguments)


def _measure(options: argparse.Namespace) -> int:
    from host_sim.lab.bench.figure import table
    from host_sim.lab.bench.fleet_figures import fleet_figures
    from host_sim.lab.bench.lockstep_figures import lockstep_figures, vcan_figure, vcan_figure_elsewhere
    from host_sim.lab.bench.page_figures import page_figures

    if options.vcan:
        figures = [vcan_figure()]
    else:
        figures = [*lockstep_figures(), vcan_figure_elsewhere(), *fleet_figures(), *page_figures()]
    as_json = options.json or options.vcan
    print(json.dumps([asdict(figure) for figure in figures], indent=2) if as_json else table(figures))
    return 0 if all(figure.reached for figure in figures) else 1


if __name__ == "__main__":
    sys.exit(main())
