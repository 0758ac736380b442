"""Lines of Vector's ASC format: CANoe, CANalyzer, python-can.

| line                                                            | what it is                                  |
| --------------------------------------------------------------- | ------------------------------------------- |
| `0.02 1  101  Rx  d 8 C2 11 64 00 64 00 D0 00  Length = 24`      | a frame; what follows its bytes is ignored  |
| `0.02 1  101  Tx  r 8`                                          | a remote frame                              |
| `0.02 1  ErrorFrame  ECC: 10100010`                             | an error frame                              |
| `0.02 CANFD  1 Rx  101  Name  1 0 8  8 C2 .. D0  102 1 303000`  | of an FD channel; flag 0x1000: an FD frame  |
| `0.02 1  Statistic: D 0 R 0`, `0.02 J1939TP ...`                | an event of another kind                    |
"""

import re
from binascii import unhexlify

from host_sim.protocol.codec import Frame
from host_sim.recording.log_text import ERROR, EXTENDED, FD, OTHER, REMOTE, Recorded

_HEADER = re.compile(
    r"(?:date|base|//|(?:no )?internal events|begin trigger|end trigger|previous log file|$)|"
    r"-?\d+\.\d+ +(?:.*(?:start of measurement|statistic:)|can +\d+ +status:)",
    re.IGNORECASE,
)
_BASE = re.compile(r"base +(hex|dec)(?: +timestamps +(absolute|relative))?", re.IGNORECASE)
_TIMED = re.compile(r"(-?\d{1,12}\.\d{1,9}) +(\S+) *(.*)", re.ASCII)
_CLASSIC = re.compile(r"([0-9A-Fa-f]+)(x?) +[RT]x +(?:(r\b)|d +([0-9A-Fa-f]+)((?: +[0-9A-Fa-f]+)*))", re.IGNORECASE)
_OF_FD = re.compile(
    r"(\d+) +[RT]x +([0-9A-Fa-f]+)(x?) +(?:[A-Za-z_]\w* +)?([01]) +([01]) +[0-9A-Fa-f] +(\d+)((?: +[0-9A-Fa-f]+)*)",
    re.ASCII,
)
_ERROR_FRAME = re.compile(r"(?:\d+ +[RT]x +)?errorframe", re.IGNORECASE)
_CUT_FRAME = re.compile(r"[0-9A-Fa-f]+x?(?: |$)|\S+ +[RT]x ")
_DATA_MAX = 8
_FLAGS_AFTER, _IS_FD = 2, 0x1000
_ID_MAX, _LONG_ID_MAX = 0x7FF, 0x1FFFFFFF


class AscReader:
    """Reads the lines of one log, in order. Times count from the first line, or from the measurement's start."""

    def __init__(self) -> None:
        self._base, self._relative = 16, False
        self._time_us, self._start_us = 0, 0

    def read(self, line: str) -> tuple[str, Recorded | str] | None:
        """Reads a line. Returns the channel and a frame, or the kind of a frame that the protocol does not use.

        None: the line is of the header, or says nothing of frames.

        Raises:
            ValueError: The line has no known form, or is cut short.
        """
        line = line.strip()
        if base := _BASE.match(line):
            self._base = 10 if base[1].lower() == "dec" else 16
            self._relative = (base[2] or "").lower() == "relative"
        timed = _TIMED.fullmatch(line)
        if timed is not None:
            self._advance(timed[1])
        if _HEADER.match(line):
            return None
        if timed is None:
            raise ValueError("not a line of ASC format")
        return self._event(*timed.groups()[1:])

    def _advance(self, stamp: str) -> None:
        """Takes the time of a line: negative before the measurement's start, and then counted from the first line."""
        time_us = round(float(stamp) * 1_000_000)
        self._time_us = self._time_us + time_us if self._relative else time_us
        self._start_us = min(self._start_us, self._time_us)

    def _event(self, channel: str, rest: str) -> tuple[str, Recorded | str]:
        if channel.upper() == "CANFD":
            return self._of_fd(rest)
        if not channel.isdigit():
            return channel, OTHER
        if _ERROR_FRAME.match(rest):
            return channel, ERROR
        frame = _CLASSIC.match(rest)
        if frame is None:
            if _CUT_FRAME.match(rest):
                raise ValueError("not a frame, or cut short")
            return channel, OTHER
        identifier, extended, remote, length, data = frame.groups()
        number = self._identifier(identifier, extended)
        if remote or extended:
            return channel, REMOTE if remote else EXTENDED
        return channel, self._frame(number, min(_DATA_MAX, int(length, self._base)), data.split())

    def _of_fd(self, rest: str) -> tuple[str, Recorded | str]:
        if _ERROR_FRAME.match(rest):
            return "", ERROR
        frame = _OF_FD.match(rest)
        if frame is None:
            if re.match(r"\d+ +[RT]x ", rest):
                raise ValueError("not a frame, or cut short")
            return "", OTHER
        channel, identifier, extended, *switches, length, words = frame.groups()
        number, data = self._identifier(identifier, extended), words.split()
        flags = int((data[int(length) :] + ["0"] * 3)[_FLAGS_AFTER], 16)
        if "1" in switches or int(length) > _DATA_MAX or flags & _IS_FD:
            return channel, FD
        if extended or not int(length):
            return channel, EXTENDED if extended else REMOTE
        return channel, self._frame(number, int(length), data)

    def _identifier(self, digits: str, extended: str) -> int:
        number = int(digits, self._base)
        if number > (_LONG_ID_MAX if extended else _ID_MAX):
            raise ValueError(f"identifier {digits} is too large")
        return number

    def _frame(self, number: int, length: int, words: list[str]) -> Recorded:
        if len(words) < length:
            raise ValueError(f"a frame of {length} bytes, cut short")
        if self._base == 10:  # noqa: PLR2004 - digits
            data = bytes(map(int, words[:length]))
        else:
            data = unhexlify("".join(words[:length]))
            if len(data) != length:
                raise ValueError("a byte that has not two digits")
        return Recorded(self._time_us - self._start_us, Frame(number, data))
