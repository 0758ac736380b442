"""`python -m host_sim.emulator`: an emulated board on a CAN bus."""

import argparse
import sys
from collections.abc import Sequence

import can

from host_sim.emulator.chips import CHIPS
from host_sim.emulator.joined import JoinedBoard
from host_sim.emulator.start import start_board
from host_sim.errors import OctetError
from host_sim.transport.buses import open_bus

_EXAMPLES = """\
examples:
  python -m host_sim.emulator --board stm32f405 --bus socketcan:vcan0
"""


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m host_sim.emulator",
        description=__doc__,
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--board", choices=CHIPS, default="stm32f405", help="which (stm32f405)")
    parser.add_argument("--bus", metavar="INTERFACE:CHANNEL", required=True, help="the python-can bus to put it on")
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


def main(arguments: Sequence[str] | None = None) -> int:
    """Does what the command line says.

    Args:
        arguments: The words after the program's name; None for those that it was started with.

    Returns:
        The exit code: 0 done, 1 fault, 2 wrong usage, 130 interrupted.
    """
    parsed = _parser().parse_args(arguments)
    try:
        _join(parsed.board, parsed.bus)
    except OctetError as error:
        sys.stderr.write(f"octet: {error}\n")
        return error.exit_code
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
