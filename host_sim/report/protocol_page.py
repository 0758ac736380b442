"""docs/protocol.md: what people have written there, and the numbers and tables of `hal/protocol/octet.dbc`.

This file, run as a module, renews the numbers and the tables.

A frame with an 11-bit identifier and n bytes of data has 47 + 8 n bits, the gap before the next one included. After
five equal bits in a row, CAN adds a stuff bit; at worst one for every four of the first 34 + 8 n bits.
"""

import re
from collections.abc import Iterable, Sequence
from itertools import groupby
from zlib import crc32

import cantools
from cantools.database.can import Database, Message
from cantools.database.can.signal import Signal

from host_sim.base.files import write_bytes
from host_sim.base.paths import ROOT
from host_sim.protocol.codec import DBC, NODE_MAX, Frame, Protocol
from host_sim.protocol.generated import LAYOUT_HASH, MESSAGES
from host_sim.protocol.generated import Message as WireMessage
from host_sim.protocol.words import BODY_PARAMETERS, PARAMETERS
from host_sim.transport.link import BIT_RATES

COMFORTABLE = 0.7
"""The bus load up to which every regular frame arrives in time."""

OPTIONAL = ("RANGES",)
"""Messages that are only sent to robots that ask for them."""

_STUFFABLE, _FIXED = 34, 13

_PAGE = ROOT / "docs" / "protocol.md"
_TABLES = "| identifier |"
"""The tables begin with this."""

_FEW = 2
_PLAIN = "Alive counter: incremented with each message of this kind."
_PARAMETERS = """
## Parameters

**set** changes these until the next **start**. Only [a stand-alone robot](hardware.md#a-stand-alone-robot) has the
`body_` parameters, and it keeps them: `tools/octet calibrate` sets and shows them.

"""
_LOAD = f"""
## Bus load

The worst case, stuff bits and interframe space included; in brackets, for robots that ask for RANGES. A bus whose
regular traffic stays within {COMFORTABLE:.0%} delivers every frame in time. `canbusload`
[measures the load](logs.md#other-programs).

"""


def page() -> str:
    """The text of docs/protocol.md."""
    database = cantools.database.load_file(DBC)
    assert isinstance(database, Database)
    messages = sorted(database.messages, key=lambda message: message.frame_id)
    head = ["| identifier | message | bytes | from |", "|---|---|---|---|"]
    overview = _prose() + "\n".join([*head, *map(_message_row, messages)]) + "\n"
    listed: dict[str, str] = {}
    sections = "".join(_section(message, listed) for message in messages)
    return overview + sections + _parameters() + _LOAD + load_tables()


def _prose() -> str:
    """The page up to its tables, as it was written, with the numbers of now."""
    stop = Protocol().encode("COMMAND", {"counter": 0, "opcode": 1, "owner": 1})
    how = {"profile": 0, "lockstep": 1, "seed": 7}
    start = Protocol().encode("COMMAND", {"counter": 1, "opcode": 2, "owner": 1, **how})
    numbers = {
        "layout, ": f"0x{LAYOUT_HASH:04X}",
        "by owner 1 with counter 0 is\n`": _text(stop),
        "For example, after `": _text(start),
        "alone, `held` is ": f"0x{crc32(start.data[1:]) & 0xFFFF:04X}",
        "node n, up to ": f"{NODE_MAX}",
    }
    text = _PAGE.read_text(encoding="utf-8").partition(_TABLES)[0]
    for before, number in numbers.items():
        text, places = re.subn(f"(?<={before})[\\w#]+", number, text)
        assert places == 1, before
    return text


def _text(frame: Frame) -> str:
    return f"{frame.id:03X}#{frame.data.hex().upper()}"


def _parameters() -> str:
    head = ["| parameter | number | range | default | meaning |", "|---|---|---|---|---|"]
    rows = [
        f"| {name} | {p.number} | {_with_unit(f'{p.minimum}..{p.maximum}', p.unit)} | {p.default} | {p.comment} |"
        for name, p in (PARAMETERS | BODY_PARAMETERS).items()
    ]
    return _PARAMETERS + "\n".join([*head, *rows]) + "\n"


def _message_row(message: Message) -> str:
    sender = ", ".join(message.senders)
    name = f"[{message.name}](#{message.name.lower()})"
    return f"| 0x{message.frame_id:03X} | {name} | {message.length} | {sender} |"


def _section(message: Message, listed: dict[str, str]) -> str:
    head = ["| signal | bits | range | meaning |", "|---|---|---|---|"]
    signals = sorted(message.signals, key=lambda signal: (signal.start, _multiplexers(signal)))
    shown = [signal for signal in signals if not _is_plain(signal)]
    alike = (list(group) for _, group in groupby(shown, key=lambda it: (it.comment, it.length, _multiplexers(it))))
    rows = [_signal_row(group, message.name, listed) for group in alike]
    return f"\n## {message.name}\n\n{message.comment}\n\n" + "\n".join([*head, *rows]) + "\n"


def _is_plain(signal: Signal) -> bool:
    """Whether the table leaves a signal out, because most messages have it."""
    return signal.name == "crc" or signal.comment == _PLAIN


def _multiplexers(signal: Signal) -> Iterable[int]:
    return signal.multiplexer_ids or ()


def _signal_row(alike: Sequence[Signal], message: str, listed: dict[str, str]) -> str:
    """The row of a signal, or of several that differ only in their place."""
    signal, end = alike[0], alike[-1]
    last = end.start + end.length - 1
    bits = f"{signal.start}..{last}" if last > signal.start else f"{signal.start}"
    meaning = " ".join(filter(None, (signal.comment, _choices(signal, message, listed))))
    name = signal.name if signal is end else f"{signal.name} to {end.name}"
    return f"| {name} | {bits} | {_with_unit(_range(signal), signal.unit or '')} | {meaning} |"


def _choices(signal: Signal, message: str, listed: dict[str, str]) -> str:
    """The words of a signal's numbers, unless its comment explains 1; if on the page already, as a link."""
    if (signal.comment or "").startswith("1: "):
        return ""
    words = [f"{number} {name}" for number, name in (signal.choices or {}).items()]
    if {str(name) for name in (signal.choices or {}).values()} == PARAMETERS.keys() | BODY_PARAMETERS.keys():
        return "[Numbers](#parameters)."
    text = f"{', '.join(words)}." if words else ""
    first = listed.setdefault(text, message)
    return text if first == message or len(words) <= _FEW else f"Numbers as in [{first}](#{first.lower()})."


def _with_unit(span: str, unit: str) -> str:
    return f"{span} x {unit}" if unit[:1].isdigit() else f"{span} {unit}".rstrip()


def _range(signal: Signal) -> str:
    """The range of a signal. cantools reads a range of 0..0 as none: the value table is used then."""
    if signal.minimum is None:
        return f"{min(signal.choices or [0])}..{max(signal.choices or [0])}"
    return f"{signal.minimum}..{signal.maximum}"


def load_tables() -> str:
    """Worst-case tables: each message, and the number of robots that fit."""
    return f"{_message_table()}\n{_fit_table()}"


def _fit_table() -> str:
    head = ["bit rate", f"robots within {COMFORTABLE:.0%}", "robots at most"]
    rows = [[_rate(rate), _fitting(COMFORTABLE * rate), _fitting(rate)] for rate in BIT_RATES]
    return _table([head, *rows])


def _fitting(bits_a_second: float) -> str:
    """How many robots fit, in general and if they use all messages."""
    return _with_brackets(str(min(NODE_MAX, int(bits_a_second / bits))) for bits in _robot_bits())


def _robot_bits() -> tuple[float, float]:
    return robot_bits_a_second(), robot_bits_a_second(optional=True)


def _with_brackets(pair: Iterable[str]) -> str:
    plain, full = pair
    return f"{plain} ({full})"


def _message_table() -> str:
    head = ["message", "bytes", "bits at worst", "frames a second", "kbit/s"]
    rows = [
        [name, str(message.length), str(worst_bits(message.length)), *_regular(message)]
        for name, message in MESSAGES.items()
        if message.cycle_ms
    ]
    return _table([head, *rows, ["a robot", "", "", "", _with_brackets(map(_kbit, _robot_bits()))]])


def _regular(message: WireMessage) -> list[str]:
    rate = frames_a_second(message)
    return [f"{rate:g}", _kbit(rate * worst_bits(message.length))]


def _table(rows: list[list[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [f"| {' | '.join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))} |" for row in rows]
    lines.insert(1, f"|{'|'.join('-' * (width + 2) for width in widths)}|")
    return "\n".join(lines) + "\n"


def _rate(bits: int) -> str:
    return f"{bits // 1000} kbit/s"


def _kbit(bits: float) -> str:
    return f"{bits / 1000:.2f}"


def worst_bits(length: int) -> int:
    """The most bits that a frame with a number of bytes of data can take."""
    stuffable = _STUFFABLE + 8 * length
    return stuffable + _FIXED + (stuffable - 1) // 4


def frames_a_second(message: WireMessage) -> float:
    """Regular rate of a message, frames per second. A message with pages is sent once per page and cycle."""
    if not message.cycle_ms:
        return 0.0
    pages = {page for signal in message.signals for page in signal.multiplexer}
    return (len(pages) or 1) * 1000 / message.cycle_ms


def robot_bits_a_second(*, optional: bool = False) -> float:
    """The most that one robot and its body send, bits a second.

    Args:
        optional: Whether the messages are sent that a robot must ask for.
    """
    sent = (message for name, message in MESSAGES.items() if optional or name not in OPTIONAL)
    return sum(frames_a_second(message) * worst_bits(message.length) for message in sent)


if __name__ == "__main__":
    write_bytes(_PAGE, page().encode())
