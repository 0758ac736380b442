"""Encodes and decodes the messages of a DBC file, with alive counters and valid CRCs."""

import re
from collections.abc import Iterable
from pathlib import Path
from random import Random
from typing import NamedTuple

import cantools
from cantools.database.can import Database, Message
from cantools.database.can.signal import Signal
from cantools.database.errors import Error as CantoolsError

from host_sim.base.errors import UsageError
from host_sim.base.frame import Frame

from .protection import PROFILES

_CRC = re.compile(r"(?:.*_)?(?:crc|checksum)\d*", re.IGNORECASE)
_COUNTER = re.compile(r"(?:.*_)?(?:counter|cnt|alive|rolling)\d*", re.IGNORECASE)


class _Guard(NamedTuple):
    """The signals that protect a message; None where it has none."""

    crc: Signal | None
    counter: Signal | None
    data_ids: list[int]


class Messages:
    """Encodes and decodes; fills in the CRC and the counter, found by names such as `crc`, `checksum` and `counter`.

    The data ID of a message is its attribute `DataID`, or 16 of them in `DataIDList`, by commas; else its identifier.

    Attributes:
        file: The DBC file.
    """

    def __init__(self, file: Path, profile: str) -> None:
        """Reads the file.

        Raises:
            UsageError: It is not a DBC file, or there is no such profile.
        """
        if profile not in PROFILES:
            raise UsageError(f"there is no CRC profile {profile!r}; there are {', '.join(PROFILES)}")
        self.file, self._profile = file, PROFILES[profile]
        try:
            database = cantools.database.load_file(file, strict=True)
        except OSError as error:
            raise UsageError(f"cannot read {file}: {error.strerror}") from None
        except (CantoolsError, ValueError, LookupError) as error:
            raise UsageError(f"{file} is not a DBC file: {str(error).partition(chr(10))[0]}") from None
        if not isinstance(database, Database) or not database.messages:
            raise UsageError(f"{file} has no messages")
        self._names = {message.name: message for message in database.messages}
        self._ids = {message.frame_id: message for message in database.messages if not message.is_extended_frame}
        self._guards = {name: self._guard(message) for name, message in self._names.items()}
        self._counts: dict[str, int] = {}

    def __getitem__(self, name: str) -> Message:
        """A message by its name.

        Raises:
            UsageError: There is no such message.
        """
        if name not in self._names:
            raise UsageError(f"{self.file} has no message {name}; it has {', '.join(sorted(self._names))}")
        return self._names[name]

    def check_names(self, name: str, signals: Iterable[str]) -> None:
        """Checks that a message has these signals.

        Raises:
            UsageError: There is no such message or signal.
        """
        known = [signal.name for signal in self[name].signals]
        for signal in signals:
            if signal not in known:
                raise UsageError(f"{name} has no signal {signal}; it has {', '.join(known)}")

    def check(self, name: str, signals: dict[str, float]) -> None:
        """Checks that a message has these signals, and that their values fit.

        Raises:
            UsageError: There is no such message or signal, or a value does not fit.
        """
        self.check_names(name, signals)
        try:
            self._encode(name, signals, strict=bool(signals))
        except (CantoolsError, OverflowError) as error:
            raise UsageError(f"{name}: {error}") from None

    def frame(self, name: str, signals: dict[str, float]) -> Frame:
        """The next frame of a message; a signal that is not given has its GenSigStartValue, or 0."""
        counter, told = self._guards[name].counter, dict(signals)
        if counter is not None and counter.name not in signals:
            count = self._counts.get(name, -1) + 1
            told[counter.name] = self._counts[name] = count % self._span(counter)
        return self._protected(name, self._encode(name, told))

    def decode(self, frame: Frame) -> tuple[str, dict[str, float]] | None:
        """The message and the signal values in a frame; None if the file has no such message.

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
        except CantoolsError as error:
            raise ValueError("damaged") from error
        return message.name, {str(name): float(str(value)) for name, value in dict(told).items()}

    def senders_of(self, node: str) -> list[str]:
        """The cyclic messages of all nodes but one.

        Raises:
            UsageError: No message has this node as its sender.
        """
        if not any(node in message.senders for message in self._names.values()):
            nodes = sorted({sender for message in self._names.values() for sender in message.senders})
            raise UsageError(f"{self.file} has no message that {node} sends; senders are {', '.join(nodes)}")
        return [name for name, message in self._names.items() if message.cycle_time and node not in message.senders]

    def forger(self, name: str) -> "Forger":
        """A sender of forged frames of a message; of all messages if the name is empty.

        Raises:
            UsageError: There is no such message.
        """
        return Forger(self, [self[name].name] if name else list(self._names))

    def forged(self, name: str, dice: Random, count: int) -> Frame:
        """A frame of a message with random content, a valid CRC and this counter."""
        data, counter = dice.randbytes(self[name].length), self._guards[name].counter
        if counter is not None:
            word, mask = int.from_bytes(data, "little"), (1 << counter.length) - 1
            word = word & ~(mask << counter.start) | (count % self._span(counter)) << counter.start
            data = word.to_bytes(len(data), "little")
        return self._protected(name, data)

    def count_in(self, frame: Frame) -> tuple[str, int]:
        """The message and the counter of a frame; an empty name if the file has no such message."""
        message = self._ids.get(frame.id)
        return ("", 0) if message is None else (message.name, self._count(message.name, frame.data))

    def _guard(self, message: Message) -> _Guard:
        named = [
            next((signal for signal in message.signals if kind.fullmatch(signal.name)), None)
            for kind in (_CRC, _COUNTER)
        ]
        told = {name: each.value for name, each in (message.dbc.attributes if message.dbc else {}).items()}
        ids = [int(each) for each in str(told.get("DataIDList") or told.get("DataID") or message.frame_id).split(",")]
        crc, bits = named[0], self._profile.bits if self._profile is not None else 0
        if crc is not None and bits and (crc.length != bits or crc.start % 8):
            raise UsageError(f"{message.name}.{crc.name} is no place for a CRC of {bits} bits")
        return _Guard(crc, named[1], ids)

    def _count(self, name: str, data: bytes) -> int:
        """The counter in the data of a message; 0 if it has none."""
        counter = self._guards[name].counter
        return 0 if counter is None else int.from_bytes(data, "little") >> counter.start & (1 << counter.length) - 1

    def _span(self, counter: Signal) -> int:
        room = 1 << counter.length
        return min(self._profile.counters or room, room) if self._profile is not None else room

    def _encode(self, name: str, signals: dict[str, float], *, strict: bool = False) -> bytes:
        message = self._names[name]
        start = {signal.name: signal.initial or 0 for signal in message.signals}
        return bytes(message.encode({**start, **signals}, strict=strict))

    def _protected(self, name: str, data: bytes) -> Frame:
        guard, frame_id = self._guards[name], self._names[name].frame_id
        if self._profile is None or guard.crc is None:
            return Frame(frame_id, data)
        first, last = guard.crc.start // 8, guard.crc.start // 8 + self._profile.bits // 8
        crc = self._profile.crc(data[:first] + data[last:], guard.data_ids, self._count(name, data))
        return Frame(frame_id, data[:first] + crc.to_bytes(last - first, "little") + data[last:])


class Forger:
    """As in `host_sim.faults.bus_faults`: listens, and continues the counters of the real sender."""

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
