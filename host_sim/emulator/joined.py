"""An emulated board on a python-can bus, by the wall's clock."""

import time

import can

from host_sim.emulator.board import EmulatedBoard
from host_sim.emulator.can_frame import CanFrame
from host_sim.protocol.codec import Frame

_SLICE_S = 0.001


class JoinedBoard:
    """Carries frames between a board and a bus.

    The board's time follows the wall's, and never runs ahead of it. Where this computer cannot keep up, the board's
    time falls behind: what the board counts as silence is never the computer's fault.
    """

    def __init__(self, board: EmulatedBoard, bus: can.BusABC) -> None:
        """Joins them as of now.

        Args:
            board: Up and running.
            bus: Open; whoever opened it closes it.
        """
        self._board, self._bus = board, bus
        self._now_s = time.monotonic()

    def step(self) -> None:
        """Waits for a frame for a millisecond at the most, and brings the board up to the present.

        Raises:
            BoardError: The image does what the hardware does not allow.
            can.CanError: The bus is gone.
        """
        message = self._bus.recv(_SLICE_S)
        if message is not None and not message.is_error_frame:
            frame = CanFrame(
                message.arbitration_id, _payload(message), message.is_extended_id, message.is_remote_frame
            )
            self._board.put(frame)
        behind_s = time.monotonic() - self._now_s
        self._now_s += min(behind_s, _SLICE_S)
        for answer in self._board.pass_time(min(behind_s, _SLICE_S)):
            self._bus.send(_message(answer))


def _payload(message: can.Message) -> bytes:
    return bytes(message.dlc) if message.is_remote_frame else bytes(message.data)


def _message(frame: Frame) -> can.Message:
    return can.Message(arbitration_id=frame.id, data=frame.data, is_extended_id=False)
