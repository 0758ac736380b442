"""Encodes and decodes frames as `hal/protocol/octet.dbc` describes them."""

from collections.abc import Callable, Mapping
from operator import itemgetter
from typing import NamedTuple

from host_sim.base.paths import ROOT
from host_sim.protocol.generated import (
    CELL_COUNT,
    LAYOUT_HASH,
    MESSAGES,
    NODE_MAX,
    RANGE_NONE,
    SAME_LAYOUT,
    Drive,
    Message,
    Ranges,
    Reason,
    Senses,
    Signal,
)
from host_sim.transport.link import Frame

__all__ = [
    "COUNTERS",
    "DBC",
    "MEMORY_IDS",
    "NODE_MAX",
    "UNSAID",
    "DecodedFrame",
    "Frame",
    "MessageLayout",
    "Protocol",
    "counter_of",
    "crc8",
    "node_of",
]

DBC = ROOT / "hal" / "protocol" / "octet.dbc"
COUNTERS = 15
"""Alive counters count from 0 to one less than this, and start again at 0."""
MEMORY_IDS = range(MESSAGES["MEMORY"].id, MESSAGES["MEMORY"].id + NODE_MAX)
"""The identifiers by which robots hear what others have learned."""
UNSAID = ("crc", "counter")
"""The signals that protect a message: they are not part of what it says."""

_LENGTH = 8
_COUNTER_START = 8
_COUNTER_MASK = 15
_REASONS = len(Reason)


class _Field(NamedTuple):
    """A signal's position; `sign` is its sign bit, 0 for an unsigned signal."""

    name: str
    start: int
    mask: int
    sign: int


def _field(signal: Signal) -> _Field:
    sign = 1 << (signal.length - 1) if signal.signed else 0
    return _Field(signal.name, signal.start, (1 << signal.length) - 1, sign)


class MessageLayout:
    """Packs and unpacks one message: all signals that are in one frame together."""

    def __init__(self, message: Message) -> None:
        """Determines the signals present for each value of the message's selector, if it has one."""
        self._message = message
        self._common = tuple(_field(signal) for signal in message.signals if not signal.multiplexer)
        self._selector = next((_field(signal) for signal in message.signals if signal.selector), None)
        numbers = {number for signal in message.signals for number in signal.multiplexer}
        self._branches = {
            number: tuple(_field(s) for s in message.signals if not s.multiplexer or number in s.multiplexer)
            for number in numbers
        }

    def pack(self, signals: Mapping[str, int]) -> bytes:
        """The data of a frame.

        Args:
            signals: The raw number of each signal in the frame, by its name.

        Raises:
            KeyError: A signal is missing.
            ValueError: A number is out of the range of its signal.
        """
        word = 0
        selected = 0 if self._selector is None else signals[self._selector.name]
        for name, start, mask, sign in self._branches.get(selected, self._common):
            number = signals[name]
            if not -sign <= number <= mask - sign:
                raise ValueError(f"{self._message.name}.{name} has no room for {number}")
            word |= (number & mask) << start
        return word.to_bytes(self._message.length, "little")

    def unpack(self, data: bytes) -> dict[str, int]:
        """The raw numbers in the data of a frame, which has the message's length."""
        word = int.from_bytes(data, "little")
        selected = 0 if self._selector is None else word >> self._selector.start & self._selector.mask
        fields = self._branches.get(selected, self._common)
        # Taking the sign bit off and adding it again below zero is what makes a number signed.
        return {name: ((word >> start & mask) ^ sign) - sign for name, start, mask, sign in fields}


def _places(message: Message) -> list[tuple[int, int, int]]:
    """Start, mask and sign bit of each signal that `Senses` or `Drive` has, in the order of their fields."""
    return [_field(signal)[1:] for signal in message.signals if signal.name not in UNSAID]


_LAYOUTS = {name: MessageLayout(message) for name, message in MESSAGES.items()}
_SENSES, _DRIVE = (_places(MESSAGES[name]) for name in ("SENSES", "DRIVE"))


class DecodedFrame(NamedTuple):
    """One frame, decoded: the message's name and the raw number of each signal by its name."""

    name: str
    signals: dict[str, int]


def _crc_table() -> bytes:
    table = bytearray()
    for byte in range(256):
        crc = byte
        for _ in range(8):
            crc = (crc << 1) ^ (0x11D if crc & 0x80 else 0)
        table.append(crc)
    return bytes(table)


_CRC_TABLE = _crc_table()


def crc8(frame_id: int, data: bytes) -> int:
    """The CRC of AUTOSAR's E2E profile 1, over an identifier, low byte first, and all data but byte 0, the CRC."""
    crc = _CRC_TABLE[_CRC_TABLE[frame_id & 0xFF] ^ (frame_id >> 8)]
    for byte in data[1:]:
        crc = _CRC_TABLE[crc ^ byte]
    return crc


class Protocol:
    """Encodes and decodes the frames of one node.

    Attributes:
        node: 1..31.
        layout: Hash of the messages' layout; see `fits`.
    """

    def __init__(self, node: int = 1) -> None:
        """Computes the node's identifiers.

        Raises:
            ValueError: node is out of range.
        """
        if not 1 <= node <= NODE_MAX:
            raise ValueError(f"node is 1..{NODE_MAX}, not {node}")
        self.node = node
        self.layout = LAYOUT_HASH
        self._by_id = {self.id_of(name): message for name, message in MESSAGES.items()}
        self._senses_id = self.id_of("SENSES")
        self._drive_id = self.id_of("DRIVE")

    @staticmethod
    def fits(layout: int) -> bool:
        """Whether a robot or a log with this hash lays out its messages as this program does."""
        return layout in SAME_LAYOUT

    def id_of(self, name: str) -> int:
        """The identifier of a message for this node."""
        return MESSAGES[name].id + self.node - 1

    def ids_from(self, sender: str) -> list[int]:
        """The identifiers of the messages that `SIM` or `ROBOT` sends."""
        return [self.id_of(name) for name, message in MESSAGES.items() if message.sender == sender]

    def choices(self, name: str, signal: str) -> dict[str, int]:
        """The value table of a signal: number by name."""
        return {choice: number for number, choice in _signal(name, signal).choices.items()}

    def choice(self, name: str, signal: str, number: int) -> str:
        """The name of a signal's number; the number itself if it has none."""
        return _signal(name, signal).choices.get(number, str(number))

    def encode(self, name: str, signals: dict[str, int]) -> Frame:
        """A frame of a message.

        Args:
            name: The message.
            signals: The raw number of each signal of the message but `crc`, by its name.

        Raises:
            KeyError: A signal is missing.
            ValueError: A number is out of the range of its signal.
        """
        frame_id, data = self.id_of(name), _LAYOUTS[name].pack({**signals, "crc": 0})
        return Frame(frame_id, bytes((crc8(frame_id, data),)) + data[1:])

    def encode_senses(self, senses: Senses, counter: int) -> Frame:
        """The frame that tells the robot its senses.

        Args:
            senses: The senses.
            counter: Alive counter, 0..14; it advances with each tick.
        """
        word = counter << _COUNTER_START
        for value, (start, _, _) in zip(senses, _SENSES, strict=True):
            word |= value << start
        data = word.to_bytes(_LENGTH, "little")
        return Frame(self._senses_id, bytes((crc8(self._senses_id, data),)) + data[1:])

    def encode_ranges(self, ranges: Ranges, tick: int, counter: int) -> Frame:
        """The frame that tells the robot distances, before its senses.

        Args:
            ranges: The distances.
            tick: Tick of the senses, 0..255.
            counter: Their alive counter.
        """
        pairs = zip(ranges._fields, ranges, strict=True)
        distances = {f"range_{sensor}": RANGE_NONE if mm is None else mm for sensor, mm in pairs}
        return self.encode("RANGES", {"counter": counter, "tick": tick, **distances})

    def decode(self, frame: Frame) -> DecodedFrame | None:
        """Decodes a frame; None if it is of another node, of a wrong length, or damaged."""
        message, data = self._by_id.get(frame.id), frame.data
        if message is None or len(data) != message.length:
            return None
        if data[0] != crc8(frame.id, data) or data[1] & _COUNTER_MASK >= COUNTERS:
            return None
        return DecodedFrame(message.name, _LAYOUTS[message.name].unpack(data))

    def decode_drive(self, frame: Frame) -> Drive | None:
        """The drive in a frame; None if it is not a valid DRIVE of this node, or its reason is unknown."""
        data = frame.data
        if frame.id != self._drive_id or len(data) != _LENGTH:
            return None
        if data[0] != crc8(frame.id, data) or data[1] & _COUNTER_MASK >= COUNTERS:
            return None
        word, values = int.from_bytes(data, "little"), []
        for start, mask, sign in _DRIVE:
            values.append(((word >> start & mask) ^ sign) - sign)  # as in `MessageLayout.unpack`
        drive = Drive._make(values)
        return drive if drive.reason < _REASONS else None

    def describe(self, frame: Frame) -> str:
        """One line for people: the message and its signals, choices by name."""
        said = self.decode(frame)
        if said is None:
            return f"{frame.id:03X}#{frame.data.hex().upper()} (not a frame of node {self.node}, or damaged)"
        parts = [
            f"{name}={_signal(said.name, name).choices.get(number, number)}"
            for name, number in said.signals.items()
            if name != "crc"
        ]
        return f"{said.name} {' '.join(parts)}"


def _signal(name: str, signal: str) -> Signal:
    return next(known for known in MESSAGES[name].signals if known.name == signal)


def node_of(frame_id: int) -> int:
    """The node that an identifier belongs to, 1..31; 0 if it belongs to none."""
    return frame_id % (NODE_MAX + 1)


def counter_of(frame: Frame) -> int:
    """The alive counter in a frame with at least two bytes: 0..14 in a valid frame."""
    return frame.data[1] & _COUNTER_MASK


_HALVES = 2
_CELLS: Callable[[dict[str, int]], tuple[int, ...]] = itemgetter(*(f"cell_{cell}" for cell in range(CELL_COUNT)))


class MemoryReport:
    """Joins the two halves of a memory, in either order."""

    def __init__(self) -> None:
        """Starts without any half."""
        self._halves: dict[int, DecodedFrame] = {}

    def join(self, decoded: DecodedFrame) -> tuple[int, ...] | None:
        """The eight cells when both halves have come; None after the first, or if one of them was lost.

        Args:
            decoded: A MEMORY.
        """
        half, counter = decoded.signals["half"], decoded.signals["counter"]
        if half not in range(_HALVES):
            return None
        other = self._halves.get(1 - half)
        self._halves = {half: decoded}
        if other is None or other.signals["counter"] != counter:
            return None
        self._halves = {}
        return _CELLS(other.signals | decoded.signals)
