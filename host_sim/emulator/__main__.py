"""`python -m host_sim.emulator`: puts an emulated board on a CAN bus, until interrupted."""

import argparse
import sys
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

import can

from host_sim.base.errors import OctetError
from host_sim.emulator.can import CanFrame
from host_sim.emulator.chips import CHIPS
from host_sim.protocol.codec import Frame
from host_sim.transport.buses import open_bus

if TYPE_CHECKING:
    from host_sim.emulator.board import EmulatedBoard

_EXAMPLE = "example: python -m host_sim.emulator --board feather_stm32f405 --bus socketcan:vcan0"
_SLICE_S = 0.001


class JoinedBoard:
    """Carries frames between a board and a bus.

    The board's time follows the wall clock and never runs ahead of it. If this computer cannot keep up, the board's
    time falls behind: silence that the board detects is never this computer's fault.
    """

    def __init__(self, board: "EmulatedBoard", bus: can.BusABC) -> None:
        """Connects the board to the bus from now on.

        Args:
            board: A running board.
            bus: An open bus; the caller closes it.
        """
        self._board, self._bus = board, bus
        self._now_s = time.monotonic()

    def step(self) -> None:
        """Waits for a frame for a millisecond at most, and brings the board up to the present.

        Raises:
            BoardError: The image did something that the hardware does not allow.
            can.CanError: The bus was closed or failed.
        """
        message = self._bus.recv(_SLICE_S)
        if message is not None and not message.is_error_frame:
            data = bytes(message.dlc) if message.is_remote_frame else bytes(message.data)
            frame = CanFrame(message.arbitration_id, data, message.is_extended_id, message.is_remote_frame)
            self._board.put(frame)
        behind_s = time.monotonic() - self._now_s
        self._now_s += min(behind_s, _SLICE_S)
        for answer in self._board.pass_time(min(behind_s, _SLICE_S)):
            self._bus.send(_message(answer))


def _message(frame: Frame) -> can.Message:
    return can.Message(arbitration_id=frame.id, data=frame.data, is_extended_id=False)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m host_sim.emulator", description=__doc__, epilog=_EXAMPLE)
    parser.add_argument(
        "--board", choices=CHIPS, default="feather_stm32f405", help="which board (default: %(default)s)"
    )
    parser.add_argument("--bus", metavar="INTERFACE:CHANNEL", required=True, help="the python-can bus that it joins")
    return parser


def _join(name: str, bus: str) -> None:
    from host_sim.emulator.board import start_board  # noqa: PLC0415 - says what to install if Unicorn is missing

    with open_bus(bus) as opened:
        joined = JoinedBoard(start_board(name), opened)
        sys.stdout.write(f"octet: an emulated {name} listens on {bus}\n")
        sys.stdout.flush()
        try:
            while True:
                joined.step()
        except (can.CanError, OSError) as error:
            raise OctetError(f"the bus {bus} is gone: {error}") from error


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command line.

    Args:
        arguments: The arguments after the program's name; None for those of this process.

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
