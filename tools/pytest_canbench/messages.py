"""Encodes and decodes the messages of a DBC file with cantools, with alive counters and valid CRCs."""

import copy
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from random import Random
from typing import Any

import cantools
from cantools.database.can import Database, Message
from cantools.database.can.signal import Signal
from cantools.database.errors import Error as CantoolsError

from host_sim.base.errors import UsageError
from host_sim.transport.link import Frame
from host_sim.transport.socket_pair import EXTENDED

from .protection import PROFILES, Profile

_CRC = re.compile(r"(?:.*_)?(?:crc|checksum)\d*", re.IGNORECASE)
_COUNTER = re.compile(r"(?:.*_)?(?:counter|cnt|alive|rolling)\d*", re.IGNORECASE)
_DATA_MAX, _TOLD_MAX = 8, 5
_NOT_MULTIPLEXED = {"is_multiplexer": False, "multiplexer_ids": None, "multiplexer_signal": None}
_UNENCODABLE = (CantoolsError, ArithmeticError, ValueError, LookupError, TypeError)
"""What cantools raises for values that do not fit."""


class _Field:
    """The place of a CRC or a counter: cantools puts a number there and takes it out, in either byte order."""

    def __init__(self, message: Message, signal: Signal) -> None:
        self.name, self.bits, self._length = signal.name, signal.length, message.length
        self._layout = _alone(message, signal, is_signed=False)
        mask = self.put(bytes(self._length), (1 << self.bits) - 1)
        self.bytes = [i for i, byte in enumerate(mask) if byte]
        self.is_whole = all(mask[i] == 0xFF for i in self.bytes)  # noqa: PLR2004 - a byte

    def get(self, data: bytes) -> int:
        """The number in the data."""
        return int(str(dict(self._layout.decode(data, scaling=False, decode_choices=False))[self.name]))

    def put(self, data: bytes, number: int) -> bytes:
        """The data with a number in this place."""
        full, new = (
            int.from_bytes(self._layout.encode({self.name: each}, scaling=False, strict=False), "big")
            for each in ((1 << self.bits) - 1, number)
        )
        return (int.from_bytes(data, "big") & ~full | new).to_bytes(self._length, "big")


class _Guard:
    """What protects a message: its CRC and its counter, of which multiplexers may select others, and its data IDs."""

    def __init__(self, message: Message, profile: Profile | None) -> None:
        """Finds the fields by their names.

        Raises:
            ValueError: They do not fit the profile, or a data ID is not a number.
        """
        self._message = message
        self._crcs, self._counters = (
            [_Field(message, signal) for signal in message.signals if kind.fullmatch(signal.name)]
            for kind in (_CRC, _COUNTER)
        )
        self.data_ids: list[int] = []
        bits = 0 if profile is None else profile.bits
        for crc in self._crcs if bits else []:
            if crc.bits != bits or not crc.is_whole:
                raise ValueError(f"{crc.name} is no place for a CRC of {bits} bits")
            self.data_ids = self.data_ids or _data_ids(message)

    def in_data(self, data: bytes) -> tuple[_Field | None, _Field | None]:
        """The CRC and the counter that these data have."""
        if not self._message.is_multiplexed():
            return next(iter(self._crcs), None), next(iter(self._counters), None)
        try:
            told = set(map(str, dict(self._message.decode(data, decode_choices=False))))
        except _UNENCODABLE:
            told = {signal.name for signal in self._message.signals if not signal.multiplexer_ids}
        crc, counter = (next((f for f in some if f.name in told), None) for some in (self._crcs, self._counters))
        return crc, counter


class Messages:
    """Encodes and decodes; fills in the CRC and the counter, found by names such as `crc`, `checksum` and `counter`.

    The data ID of a message is its attribute `DataID`, or 16 of them in `DataIDList`, by commas; else its identifier.
    A `Frame.id` has the flag `EXTENDED` if the identifier has 29 bits.

    Attributes:
        file: The DBC file.
        refused: Why some messages cannot be used, by name.
    """

    def __init__(self, file: Path, profile: str) -> None:
        """Reads the file.

        Raises:
            UsageError: It is not a DBC file, or there is no such profile.
        """
        if profile not in PROFILES:
            raise UsageError(f"there is no CRC profile {profile!r}; there are {', '.join(PROFILES)}")
        self.file, self._profile = file, PROFILES[profile]
        self.refused: dict[str, str] = {}
        self._names: dict[str, Message] = {}
        self._ids: dict[int, Message] = {}
        self._guards: dict[str, _Guard] = {}
        self._counts: dict[str, int] = {}
        for message in _read(file):
            self._add(message)

    def __getitem__(self, name: str) -> Message:
        """A message by its name.

        Raises:
            UsageError: There is no such message, or it cannot be used.
        """
        if name not in self._names:
            raise UsageError(f"{self.file} has no message {name}; it has {', '.join(sorted(self._names))}")
        if name in self.refused:
            raise UsageError(f"{name} cannot be used: {self.refused[name]}")
        return self._names[name]

    def odd(self) -> str:
        """What the file has that cannot be used, in a line; empty if all is well."""
        reasons = [f"{name}: {why}" for name, why in self.refused.items()]
        more = f"; and {len(reasons) - _TOLD_MAX} more" if len(reasons) > _TOLD_MAX else ""
        return (
            f"{self.file}: these messages cannot be used: {'; '.join(reasons[:_TOLD_MAX])}{more}" if reasons else ""
        )

    def check_names(self, name: str, signals: Iterable[str]) -> None:
        """Checks that a message has these signals.

        Raises:
            UsageError: There is no such message or signal.
        """
        known = [signal.name for signal in self[name].signals]
        for signal in signals:
            if signal not in known:
                raise UsageError(f"{name} has no signal {signal}; it has {', '.join(known)}")

    def check(self, name: str, signals: Mapping[str, float | str]) -> None:
        """Checks that a message has these signals, and that their values fit.

        Raises:
            UsageError: There is no such message or signal, or a value does not fit.
        """
        self.check_names(name, signals)
        try:
            values = _values(self[name], signals)
            for unused in signals.keys() - values.keys():
                raise ValueError(f"its multiplexers do not select {unused}")
            for signal in signals:
                alone = _alone(self[name], self[name].get_signal_by_name(signal))
                alone.encode({signal: values[signal]}, strict=True)
            self[name].encode(values, strict=False)
        except _UNENCODABLE as error:
            raise UsageError(f"{name} cannot be encoded: {str(error) or type(error).__name__}") from None

    def frame(self, name: str, signals: Mapping[str, float | str]) -> Frame:
        """The next frame of a message; a signal that is not given has its GenSigStartValue, or is nearest to 0."""
        message = self[name]
        data = bytes(message.encode(_values(message, signals), strict=False))
        _, counter = self._guards[name].in_data(data)
        if counter is not None and counter.name not in signals:
            self._counts[name] = (self._counts.get(name, -1) + 1) % self._span(counter)
            data = counter.put(data, self._counts[name])
        return self._protected(name, data)

    def decode(self, frame: Frame) -> tuple[str, dict[str, float]] | None:
        """The message and the signal values in a frame; None if the file has no such message, or it cannot be used.

        Raises:
            ValueError: It is damaged: its length or its CRC is wrong, or it cannot be read.
        """
        message = self._ids.get(frame.id)
        if message is None:
            return None
        if len(frame.data) != message.length or self._protected(message.name, frame.data) != frame:
            raise ValueError("damaged")
        try:
            told = message.decode(frame.data, decode_choices=False)
        except _UNENCODABLE as error:
            raise ValueError("damaged") from error
        return message.name, {str(name): float(str(value)) for name, value in dict(told).items()}

    def senders_of(self, node: str) -> list[str]:
        """The cyclic messages of all nodes but one, without those that cannot be used.

        Raises:
            UsageError: No message has this node as its sender.
        """
        if not any(node in message.senders for message in self._names.values()):
            nodes = sorted({sender for message in self._names.values() for sender in message.senders})
            raise UsageError(f"{self.file} has no message that {node} sends; senders are {', '.join(nodes)}")
        others = [name for name, message in self._names.items() if message.cycle_time and node not in message.senders]
        return [name for name in others if name not in self.refused]

    def forger(self, name: str) -> "Forger":
        """A sender of forged frames of a message; of all messages if the name is empty.

        Raises:
            UsageError: There is no such message.
        """
        return Forger(self, [self[name].name] if name else [each for each in self._names if each not in self.refused])

    def forged(self, name: str, dice: Random, count: int) -> Frame:
        """A frame of a message with random content, a valid CRC and this counter."""
        data = dice.randbytes(self[name].length)
        _, counter = self._guards[name].in_data(data)
        if counter is not None:
            data = counter.put(data, count % self._span(counter))
        return self._protected(name, data)

    def count_in(self, frame: Frame) -> tuple[str, int]:
        """The message and the counter of a frame; an empty name if the file has no such message."""
        message = self._ids.get(frame.id)
        if message is None or len(frame.data) != message.length:
            return "", 0
        return message.name, self._count(message.name, frame.data)

    def _add(self, message: Message) -> None:
        try:
            self._admit(message)
        except (CantoolsError, ValueError) as error:
            self.refused[message.name] = str(error)
        self._names.setdefault(message.name, message)

    def _admit(self, message: Message) -> None:
        if message.name in self._names:
            raise ValueError("there are two messages of this name")
        if message.length > _DATA_MAX:
            raise ValueError(f"it has {message.length} bytes, and a frame of classic CAN at most {_DATA_MAX}")
        frame_id = message.frame_id | (EXTENDED if message.is_extended_frame else 0)
        if frame_id in self._ids:
            raise ValueError(f"its identifier is that of {self._ids[frame_id].name}")
        message.refresh(strict=True)
        self._guards[message.name] = _Guard(message, self._profile)
        self._ids[frame_id] = message

    def _count(self, name: str, data: bytes) -> int:
        """The counter in the data of a message; 0 if it has none."""
        _, counter = self._guards[name].in_data(data)
        return 0 if counter is None else counter.get(data)

    def _span(self, counter: _Field) -> int:
        room = 1 << counter.bits
        return min(self._profile.counters or room, room) if self._profile is not None else room

    def _protected(self, name: str, data: bytes) -> Frame:
        message, guard = self._names[name], self._guards[name]
        frame_id = message.frame_id | (EXTENDED if message.is_extended_frame else 0)
        crc, _ = guard.in_data(data)
        if self._profile is None or crc is None:
            return Frame(frame_id, data)
        rest = bytes(byte for i, byte in enumerate(data) if i not in crc.bytes)
        return Frame(frame_id, crc.put(data, self._profile.crc(rest, guard.data_ids, self._count(name, data))))


def _read(file: Path) -> list[Message]:
    """The messages of a file: with `strict=False` also those that are odd, each of which is checked when used."""
    try:
        database = cantools.database.load_file(file, strict=False)
    except OSError as error:
        raise UsageError(f"cannot read {file}: {error.strerror}") from None
    except (CantoolsError, ValueError, LookupError) as error:
        raise UsageError(f"{file} is not a DBC file that cantools reads: {' '.join(str(error).split())}") from None
    if not isinstance(database, Database) or not database.messages:
        raise UsageError(f"{file} has no messages")
    return database.messages


def _data_ids(message: Message) -> list[int]:
    told = {name: each.value for name, each in (message.dbc.attributes if message.dbc else {}).items()}
    text = str(told.get("DataIDList") or told.get("DataID") or message.frame_id)
    try:
        return [int(each, 16 if each.strip().lower().startswith("0x") else 10) for each in text.split(",")]
    except ValueError:
        raise ValueError(f"its DataID is not a number: {text}") from None


def _alone(message: Message, signal: Signal, **changed: Any) -> Message:
    """A message that has this signal only, and always."""
    only = copy.copy(signal)
    for name, value in {**_NOT_MULTIPLEXED, **changed}.items():
        setattr(only, name, value)
    return Message(0, message.name, message.length, [only], strict=False)


def _start(signal: Signal) -> float:
    """What a signal has before anyone gives it a value: its GenSigStartValue, or the allowed value nearest to 0."""
    if signal.raw_initial is not None:
        raw: float = signal.raw_initial
    else:
        least, most = signal.minimum or 0, 0 if signal.maximum is None else signal.maximum
        raw = signal.conversion.numeric_scaled_to_raw(max(least, min(0, most)))
    if not signal.is_float:
        room = 1 << signal.length
        bottom = -room // 2 if signal.is_signed else 0
        raw = min(max(raw, bottom), bottom + room - 1)
    return float(str(signal.raw_to_scaled(raw, decode_choices=False)))


def _numbers(message: Message, signals: Mapping[str, float | str]) -> dict[str, float]:
    """The values of signals, with numbers in place of names that the file has for them."""
    numbers = {}
    for name, value in signals.items():
        signal = message.get_signal_by_name(name)
        numbers[name] = _named(signal, value) if isinstance(value, str) else value
    return numbers


def _named(signal: Signal, name: str) -> float:
    raw = {str(text): number for number, text in (signal.choices or {}).items()}
    if name not in raw:
        raise ValueError(f"{signal.name} has no value {name!r}; it has {', '.join(raw) or 'none with a name'}")
    return float(str(signal.raw_to_scaled(raw[name], decode_choices=False)))


def _values(message: Message, signals: Mapping[str, float | str]) -> dict[str, float]:
    """The value of each signal that the message then has: multiplexers select the signals that are given."""
    given = _numbers(message, signals)
    values: dict[str, float] = {}

    def fill(tree: Any) -> None:
        for node in tree:
            if isinstance(node, str):
                values[node] = given[node] if node in given else _start(message.get_signal_by_name(node))
                continue
            for name, branches in node.items():
                selector = message.get_signal_by_name(name)
                values[name] = given[name] if name in given else _selected(selector, branches, given)
                fill(branches.get(values[name], []))

    fill(message.signal_tree)
    return values


def _selected(selector: Signal, branches: Mapping[int, Any], given: Mapping[str, float]) -> int:
    """The branch of a multiplexer with most of the signals that are given, and nearest to the selector's start."""
    start = _start(selector)
    return min(branches, key=lambda n: (-len(given.keys() & {*_within(branches[n])}), abs(n - start)))


def _within(tree: Any) -> Iterator[str]:
    """The names of all signals in a tree of cantools."""
    for node in tree:
        if isinstance(node, str):
            yield node
        else:
            for name, branches in node.items():
                yield name
                for branch in branches.values():
                    yield from _within(branch)


class Forger:
    """As in `host_sim.transport.faulty_link`: listens, and continues the counters of the real sender."""

    def __init__(self, messages: Messages, names: list[str]) -> None:
        self._messages, self._names, self._counts = messages, names, dict[str, int]()

    def hear(self, frame: Frame) -> None:
        """Notes the counter of a frame on the bus."""
        name, count = self._messages.count_in(frame)
        self._counts[name] = count

    def forge(self, dice: Random) -> Frame:
        """A frame with a valid CRC and the next counter."""
        name = dice.choice(self._names)
        self._counts[name] = self._counts.get(name, -1) + 1
        return self._messages.forged(name, dice, self._counts[name])
