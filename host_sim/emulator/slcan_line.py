"""Frames as slcan text on the board's serial line."""

from collections.abc import Callable

from host_sim.emulator.can_frame import CanFrame
from host_sim.transport.slcan_link import decode

_END = ord("\r")


class SlcanLine:
    """Puts together what the board sends byte by byte."""

    def __init__(self, heard: Callable[[CanFrame], None]) -> None:
        """At the beginning of a line.

        Args:
            heard: Takes each frame.
        """
        self._heard = heard
        self._text = bytearray()

    def take(self, byte: int) -> None:
        """The board has sent that. A line that is no frame is nobody's, and dropped."""
        if byte != _END:
            self._text.append(byte)
            return
        frame = decode(bytes(self._text))
        self._text.clear()
        if frame is not None:
            self._heard(CanFrame(frame.id, frame.data))
