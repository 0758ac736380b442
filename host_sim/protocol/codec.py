"""The wire, as `hal/protocol/octet.dbc` has it: what the simulator sends to frames, frames to what the robot says."""

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import cantools
from cantools.database.can import Database

from host_sim.paths import ROOT
from host_sim.protocol.generated import LAYOUT_HASH, NODE_MAX, SAME_LAYOUT
from host_sim.protocol.signal_layout import Layout
from host_sim.robot_io import Drive, Senses

__all__ = ["CONTROL", "DBC", "NODE_MAX", "DecodedFrame", "Frame", "Protocol", "crc8", "drive_from"]

DBC = ROOT / "hal" / "protocol" / "octet.dbc"
CONTROL = ("COMMAND", "DRIVE", "SENSES", "ANSWER")
"""The messages that carry a CRC."""


_LENGTH = 8
# In the order of the fields of `Senses` and of `Drive`.
_SENSES = ("tick", "feel", "bump", "look", "beacon", "odometer_left", "odometer_right")
_DRIVE = ("tick", "left", "right", "reason", "repeat_count", "action", "eat")


class Frame(NamedTuple):
    """One CAN frame with an 11-bit identifier, and 0..8 bytes of data."""

    id: int
    data: bytes


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
    """CRC-8 SAE J1850 over an identifier, low byte first, and all data but byte 0, where the result is kept."""
    crc = _CRC_TABLE[_CRC_TABLE[0xFF ^ (frame_id & 0xFF)] ^ (frame_id >> 8)]
    for byte in data[1:]:
        crc = _CRC_TABLE[crc ^ byte]
    return crc ^ 0xFF


class Protocol:
    """Encodes and decodes the frames of one node.

    Attributes:
        node: 1..63.
        dbc_hash: Hash of the messages' layout; see `fits`.
    """

    def __init__(self, node: int = 1, dbc: Path = DBC) -> None:
        """Reads the DBC file.

        Raises:
            ValueError: node is out of range.
        """
        if not 1 <= node <= NODE_MAX:
            raise ValueError(f"node is 1..{NODE_MAX}, not {node}")
        self.node = node
        self.dbc_hash = LAYOUT_HASH
        database = cantools.database.load_file(dbc)
        assert isinstance(database, Database)
        self._messages = {message.name: message for message in database.messages}
        self._by_id = {self.id_of(name): message for name, message in self._messages.items()}
        self._senses = Layout(self._messages["SENSES"], _SENSES)
        self._senses_id = self.id_of("SENSES")
        self._drive = Layout(self._messages["DRIVE"], _DRIVE)
        self._drive_id = self.id_of("DRIVE")

    @staticmethod
    def fits(dbc_hash: int) -> bool:
        """Whether a robot or a log with this hash has the messages laid out as here."""
        return dbc_hash in SAME_LAYOUT

    def id_of(self, name: str) -> int:
        """The identifier of a message for this node."""
        return self._messages[name].frame_id + self.node - 1

    def ids_from(self, sender: str) -> list[int]:
        """The identifiers of the messages that `SIM` or `ROBOT` sends."""
        return [self.id_of(name) for name, message in self._messages.items() if sender in message.senders]

    def choices(self, name: str, signal: str) -> dict[str, int]:
        """The value table of a signal: number by name."""
        choices: Mapping[int, object] = self._messages[name].get_signal_by_name(signal).choices or {}
        return {str(choice): number for number, choice in choices.items()}

    def encode(self, name: str, signals: dict[str, int]) -> Frame:
        """A frame of a message that carries a CRC.

        Args:
            name: The message.
            signals: Raw numbers within each signal's range, all that the message has but `crc`.
        """
        data = self._messages[name].encode({**signals, "crc": 0}, scaling=False, strict=False)
        return _protected(self.id_of(name), data)

    def encode_senses(self, senses: Senses) -> Frame:
        """The frame that tells the robot its senses."""
        data = self._senses.pack(senses).to_bytes(8, "little")
        return _protected(self._senses_id, data)

    def decode(self, frame: Frame) -> DecodedFrame | None:
        """What a frame says; None if it is not this node's, of a wrong length, or damaged."""
        message = self._by_id.get(frame.id)
        if message is None or len(frame.data) != message.length:
            return None
        if message.name in CONTROL and frame.data[0] != crc8(frame.id, frame.data):
            return None
        signals = message.decode(frame.data, decode_choices=False, scaling=False)
        return DecodedFrame(message.name, signals)  # type: ignore[arg-type] # unscaled and without choices, all are int

    def decode_drive(self, frame: Frame) -> Drive | None:
        """The drive in a frame; None if it is no whole DRIVE of this node."""
        data = frame.data
        if frame.id != self._drive_id or len(data) != _LENGTH or data[0] != crc8(frame.id, data):
            return None
        return Drive._make(self._drive.unpack(int.from_bytes(data, "little")))

    def describe(self, frame: Frame) -> str:
        """One line for people: the message and its signals, choices by name."""
        said = self.decode(frame)
        if said is None:
            return f"{frame.id:03X}#{frame.data.hex().upper()} (no frame of node {self.node}, or damaged)"
        parts = [f"{key}={self._spelt(said.name, key, value)}" for key, value in said.signals.items() if key != "crc"]
        return f"{said.name} {' '.join(parts)}"

    def _spelt(self, name: str, signal: str, value: int) -> str:
        choices: Mapping[int, object] = self._messages[name].get_signal_by_name(signal).choices or {}
        return str(choices.get(value, value))


def node_of(frame_id: int) -> int:
    """The node that an identifier belongs to, 1..63; 0 for one of no node."""
    return frame_id % (NODE_MAX + 1)


def _protected(frame_id: int, data: bytes) -> Frame:
    """A frame with its CRC in byte 0."""
    return Frame(frame_id, bytes((crc8(frame_id, data),)) + data[1:])


def drive_from(said: DecodedFrame) -> Drive:
    """The drive in a decoded DRIVE frame."""
    return Drive._make(said.signals[name] for name in _DRIVE)
