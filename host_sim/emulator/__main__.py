"""`python -m host_sim.emulator`: an emulated board on a CAN bus, or what a tick costs on it."""

import argparse
import json
import sys
from collections.abc import Sequence

import can

from host_sim.backends.connection import open_bus
from host_sim.emulator.chips import CHIPS
from host_sim.emulator.joined import JoinedBoard
from host_sim.emulator.start import start_board
from host_sim.emulator.tick_cost import count_ticks
from host_sim.errors import OctetError

_EXAMPLES = """\
examples:
  python -m host_sim.emulator --board stm32f405 --bus socketcan:vcan0
  python -m host_sim.emulator --board stm32f103 --count-instructions --ticks 5000
"""


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m host_sim.emulator",
        description=__doc__,
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--board", choices=CHIPS, default="stm32f405", help="which (stm32f405)")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--bus", metavar="INTERFACE:CHANNEL", help="put it on that python-can bus until interrupted")
    what.add_argument("--count-instructions", action="store_true", help="print what ticks of a run cost, as JSON")
    parser.add_argument("--ticks", type=int, default=5000, help="length of that run (5000)")
    parser.add_argument("--seed", type=int, default=1, help="of that run (1)")
    return parser


def _join(board: str, bus: str) -> None:
    with open_bus(bus) as opened:
        joined = JoinedBoard(start_board(board), opened)
        sys.stdout.write(f"octet: an emulated {board} listens on {bus}\n")
        sys.stdout.flush()
        try:
            while True:
                joined.step()
        except (can.CanError, OSError) as error:
            raise OctetError(f"the bus {bus} is gone: {error}") from error


def _count(board: str, seed: int, ticks: int) -> None:
    counts = count_ticks(board, seed, ticks)
    cost = {"board": board, "ticks": len(counts), "worst": max(counts), "mean": round(sum(counts) / len(counts))}
    sys.stdout.write(json.dumps(cost) + "\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Does what the command line says.

    Args:
        arguments: The words after the program's name; None for those that it was started with.

    Returns:
        The exit code: 0 done, 1 fault, 2 wrong usage, 130 interrupted.
    """
    parsed = _parser().parse_args(arguments)
    try:
        if parsed.count_instructions:
            _count(parsed.board, parsed.seed, parsed.ticks)
        else:
            _join(parsed.board, parsed.bus)
    except OctetError as error:
        sys.stderr.write(f"octet: {error}\n")
        return error.exit_code
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
