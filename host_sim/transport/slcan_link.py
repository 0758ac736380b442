"""Frames as slcan text over a stream socket: `tIIILDD..` and a carriage return for each."""

import re
import select
import socket

from host_sim.errors import RobotError
from host_sim.protocol.codec import Frame

_LINE = re.compile(rb"t([0-9A-Fa-f]{3})([0-8])((?:[0-9A-Fa-f]{2}){0,8})")
_CHUNK = 4096
_SEND_S = 1.0


def encode(frame: Frame) -> bytes:
    """The line of a frame, with its end."""
    return b"t%03X%d%s\r" % (frame.id, len(frame.data), frame.data.hex().upper().encode("ascii"))


def decode(line: bytes) -> Frame | None:
    """The frame in a line without its end; None if it is none with an 11-bit identifier and data."""
    match = _LINE.fullmatch(line)
    if match is None or len(match[3]) != 2 * int(match[2]):
        return None
    return Frame(int(match[1], 16), bytes.fromhex(match[3].decode("ascii")))


class SlcanLink:
    """A link over one end of a connected stream socket, which `close` closes."""

    def __init__(self, end: socket.socket) -> None:
        """Takes over the socket."""
        self._socket = end
        self._socket.settimeout(_SEND_S)
        self._text = b""

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        try:
            self._socket.sendall(encode(frame))
        except OSError as error:
            raise RobotError(f"cannot send to the robot: {error}") from error

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`. A line that is no frame of ours has the id -1."""
        while b"\r" not in self._text:
            if not select.select([self._socket], [], [], timeout_s)[0]:
                return None
            self._refill()
        line, _, self._text = self._text.partition(b"\r")
        return decode(line) or Frame(-1, b"")

    def close(self) -> None:
        """As in `Link`."""
        self._socket.close()

    def _refill(self) -> None:
        try:
            chunk = self._socket.recv(_CHUNK)
        except OSError as error:
            raise RobotError(f"cannot hear the robot: {error}") from error
        if not chunk:
            raise RobotError("cannot hear the robot: its end of the line is closed")
        self._text += chunk
