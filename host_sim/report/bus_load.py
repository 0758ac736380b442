"""Bus load of the robots at worst, from octet.dbc, as tables in Markdown.

A frame with an 11-bit identifier and n bytes of data has 47 + 8 n bits, the gap before the next one included. After
five equal bits in a row, CAN adds a stuff bit; at worst one for every four of the first 34 + 8 n bits.
"""

from collections.abc import Iterable

from host_sim.protocol.codec import NODE_MAX
from host_sim.protocol.generated import MESSAGES, Message
from host_sim.transport.link import BIT_RATES

COMFORTABLE = 0.7
"""The bus load up to which every regular frame arrives in time."""

OPTIONAL = ("RANGES",)
"""Messages that are only sent to robots that ask for them."""

_STUFFABLE, _FIXED = 34, 13


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


def _regular(message: Message) -> list[str]:
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


def frames_a_second(message: Message) -> float:
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
