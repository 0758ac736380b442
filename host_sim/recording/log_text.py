"""Frames as text, one line each: the formats of candump, python-can and asc2log.

| written by                          | a line                                                             |
| ----------------------------------- | ------------------------------------------------------------------ |
| `candump -L`, `-l`; a run's own log | `(1700000000.020000) can0 041#C3110100`                            |
| python-can, asc2log, `candump -Lx`  | the same, followed by ` R` or ` T`                                 |
| `candump -ta`, `log2long`           | ` (1700000000.020000)  can0  041   [4]  C3 11 01 00`               |
| `candump -tA`                       | ` (2026-11-21 18:26:30.020000)  can0  041   [4]  C3 11 01 00`      |
| `candump -tz`, `candump -td`        | ` (000.020000)  can0  041   [4]  C3 11 01 00`                      |
| `candump`                           | `  can0  041   [4]  C3 11 01 00`: without a time, which is then 0   |
| `candump -x`, `-a`, `-c`            | with `RX - -` or `TX B E`, with the bytes as text, with colours     |

Lines of Vector's ASC format: CANoe, CANalyzer, python-can.

| line                                                            | what it is                                  |
| --------------------------------------------------------------- | ------------------------------------------- |
| `0.02 1  101  Rx  d 8 C2 11 64 00 64 00 D0 00  Length = 24`      | a frame; what follows its bytes is ignored  |
| `0.02 1  101  Tx  r 8`                                          | a remote frame                              |
| `0.02 1  ErrorFrame  ECC: 10100010`                             | an error frame                              |
| `0.02 CANFD  1 Rx  101  Name  1 0 8  8 C2 .. D0  102 1 303000`  | of an FD channel; flag 0x1000: an FD frame  |
| `0.02 1  Statistic: D 0 R 0`, `0.02 J1939TP ...`                | an event of another kind                    |
"""

import calendar
import re
from binascii import unhexlify
from collections.abc import Iterable
from typing import NamedTuple

from host_sim.protocol.codec import Frame


class Recorded(NamedTuple):
    """One frame of a log, and its time in us: robot time in a run's own log."""

    time_us: int
    frame: Frame


EXTENDED, REMOTE, FD, XL, ERROR = "extended", "remote", "FD", "XL", "error"
"""Kinds of frames that the robot's protocol does not use."""

OTHER = "other"
"""The kind of lines with a time that hold no frame: events of another bus, comments of another program."""

_HEX2 = rb"[0-9A-Fa-f]{2}"
_STAMP = rb"\((\d{1,12})\.(\d{6})(?:\d{3})?\)"
_END = rb"(?: [RT])?\r?\n"
_FRAME = re.compile(_STAMP + rb" +(\S+) +([0-9A-Fa-f]{3})#((?:" + _HEX2 + rb"){0,8})(?:_[9A-Fa-f])?" + _END)
_OTHER = re.compile(
    _STAMP + rb" +\S+ +(?:([0-9A-Fa-f]{3}|[0-9A-Fa-f]{8})#"
    rb"(?:(R[0-9A-Fa-f]?)|(#[0-9A-Fa-f](?:" + _HEX2 + rb"){0,64})|(?:" + _HEX2 + rb"){0,8})(?:_[9A-Fa-f])?"
    rb"|([0-9A-Fa-f]{3,5}#" + _HEX2 + rb":" + _HEX2 + rb":[0-9A-Fa-f]{8}#(?:" + _HEX2 + rb")+))" + _END
)
_LONG = re.compile(
    rb" *(?:\(([^)]*)\))? +(\S+)(?: +[RT]X +[B-] [E-])? +([0-9A-Fa-f]{3}|[0-9A-Fa-f]{8}) +"
    rb"[\[{]([0-9A-Fa-f]{1,2})[\]}] *"
    rb"(?:(remote request)|((?:" + _HEX2 + rb"(?: (?=[0-9A-Fa-f]))?)*)(?: +'.*')?(?: +ERRORFRAME)?) *\r?\n"
)
_SECONDS = re.compile(rb"(\d{1,12})\.(\d{6})(?:\d{3})?")
_DATE = re.compile(rb"(\d{4})-(\d\d)-(\d\d) (\d\d):(\d\d):(\d\d)\.(\d{6})(?:\d{3})?")
_RELATIVE = re.compile(rb" +\((\d{3,9})\.(\d{6})")
_COLOUR = re.compile(rb"\x1b\[[\d;]*m")
_ERROR_FLAG = 0x20000000
_SILENT = (b"\n", b"\r\n")


class LineReader:
    """Reads the lines of one log, in order.

    Attributes:
        deltas: Whether relative time stamps count from the previous line (`candump -td`).
    """

    def __init__(self, *, deltas: bool = False) -> None:
        self.deltas = deltas
        self._time_us = 0

    def read(self, line: bytes) -> tuple[bytes, Recorded | str] | None:
        """Reads a line with its line end.

        Returns the interface and a frame, or the kind of a frame that the protocol does not use.

        None: the line has no frame; it is empty, or explains an error frame (`candump -e`).

        Raises:
            ValueError: The line has no known format, or is cut short.
        """
        match = _FRAME.fullmatch(line)
        if match is not None:
            seconds, micros, interface, frame_id, data = match.groups()
            time_us = int(seconds) * 1_000_000 + int(micros)
            return interface, Recorded(time_us, Frame(int(frame_id, 16), unhexlify(data)))
        return self._read_other(_COLOUR.sub(b"", line))

    def _read_other(self, line: bytes) -> tuple[bytes, Recorded | str] | None:
        if line in _SILENT or (line.startswith(b"\t") and line.endswith(b"\n")):
            return None
        if match := _OTHER.fullmatch(line):
            *_, frame_id, remote, fd, xl = match.groups()
            return b"", XL if xl else _kind(frame_id, fd=fd is not None, remote=remote is not None)
        if match := _LONG.fullmatch(line):
            return match[2], self._read_long(match)
        raise ValueError("not a frame, or cut short")

    def _read_long(self, match: re.Match[bytes]) -> Recorded | str:
        stamp, _, frame_id, length, remote, data = match.groups()
        time_us = self._time_of(stamp)
        fd = len(length) > 1
        if remote or fd or len(frame_id) > 3:  # noqa: PLR2004 - the digits of an 11-bit identifier
            return _kind(frame_id, fd=fd, remote=remote is not None)
        content = bytes.fromhex(data.decode("ascii"))
        if len(content) != min(int(length, 16), 8):
            raise ValueError(f"a frame of {int(length, 16)} bytes with {len(content)}")
        return Recorded(time_us, Frame(int(frame_id, 16), content))

    def _time_of(self, stamp: bytes | None) -> int:
        if stamp is None:
            return 0
        time_us = time_in(stamp)
        if self.deltas:
            time_us += self._time_us
        self._time_us = time_us
        return time_us


def time_in(stamp: bytes) -> int:
    """The time of a time stamp, us. The stamp is in seconds, or a date, taken as UTC.

    Raises:
        ValueError: The stamp is neither.
    """
    if match := _SECONDS.fullmatch(stamp):
        return int(match[1]) * 1_000_000 + int(match[2])
    if match := _DATE.fullmatch(stamp):
        *date, micros = (int(number) for number in match.groups())
        return calendar.timegm((*date, 0, 0, 0)) * 1_000_000 + micros
    raise ValueError("not a time stamp")


def counts_from_the_line_before(lines: Iterable[bytes]) -> bool:
    """Whether the relative time stamps of a log are differences: these decrease somewhere."""
    last = 0
    for line in lines:
        match = _RELATIVE.match(line)
        if match is None:
            continue
        time_us = int(match[1]) * 1_000_000 + int(match[2])
        if time_us < last:
            return True
        last = time_us
    return False


def is_relative(line: bytes) -> bool:
    """Whether a line has a relative time stamp, as written by `candump -tz` or `-td`."""
    return _RELATIVE.match(line) is not None


def _kind(frame_id: bytes, *, fd: bool, remote: bool) -> str:
    if len(frame_id) > 3 and int(frame_id, 16) & _ERROR_FLAG:  # noqa: PLR2004 - as above
        return ERROR
    if fd:
        return FD
    return REMOTE if remote else EXTENDED


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
