"""The hash that tells whether two ends of the wire fit: of what decides where a bit lies, and of nothing else."""

import hashlib

from cantools.database.can import Database
from cantools.database.can.signal import Signal


def layout_text(database: Database) -> str:
    """The layout of all messages, one line for each message and signal, the same however the file was written."""
    lines: list[str] = []
    for message in sorted(database.messages, key=lambda message: message.frame_id):
        lines.append(f"{message.frame_id} {message.length}")
        lines += sorted(_signal_line(signal) for signal in message.signals)
    return "\n".join(lines) + "\n"


def layout_hash(database: Database) -> int:
    """The first two bytes of the SHA-256 of `layout_text`, the first one in the high half."""
    return int.from_bytes(hashlib.sha256(layout_text(database).encode()).digest()[:2], "big")


def _signal_line(signal: Signal) -> str:
    sign = "-" if signal.is_signed else "+"
    selects = "M" if signal.is_multiplexer else ""
    selected_by = ",".join(str(number) for number in sorted(signal.multiplexer_ids or ()))
    return f" {signal.start:02} {signal.name} {signal.length} {signal.byte_order} {sign} {selects}{selected_by}"
