"""Bus load of the robots: worst case from octet.dbc, and measured from a log. The tables are in Markdown."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from host_sim.protocol.codec import NODE_MAX
from host_sim.protocol.every_node import hear
from host_sim.protocol.frame_bits import OPTIONAL, frame_bits, frames_a_second, robot_bits_a_second, worst_bits
from host_sim.protocol.generated import MESSAGES, Message
from host_sim.recording.log_text import Recorded
from host_sim.transport.bit_rates import BIT_RATES

COMFORTABLE = 0.7
"""The bus load up to which every regular frame arrives in time."""


@dataclass
class Share:
    """The measured traffic of one message.

    Attributes:
        frames: Number of frames.
        bits: Bits on the bus, stuff bits included.
        worst: Maximum number of bits of frames of these lengths.
    """

    frames: int = 0
    bits: int = 0
    worst: int = 0


@dataclass
class MeasuredLoad:
    """The measured traffic of a log.

    Attributes:
        seconds: Time from the first frame to the last.
        nodes: Node numbers of the robots.
        messages: Traffic of each message, all robots together.
    """

    seconds: float = 0.0
    nodes: set[int] = field(default_factory=set)
    messages: dict[str, Share] = field(default_factory=dict)

    @property
    def bits_a_second(self) -> float:
        """Bits per second of all messages together."""
        return sum(share.bits for share in self.messages.values()) / self.seconds if self.seconds else 0.0


def measure(log: Iterable[Recorded]) -> MeasuredLoad:
    """Counts the bits of a log's frames."""
    load, first_us = MeasuredLoad(), None
    for time_us, frame in log:
        heard = hear(frame)
        if heard is None:
            continue
        first_us = time_us if first_us is None else first_us
        load.seconds = (time_us - first_us) / 1e6
        load.nodes.add(heard.node)
        share = load.messages.setdefault(heard.name, Share())
        share.frames += 1
        share.bits += frame_bits(frame)
        share.worst += worst_bits(len(frame.data))
    return load


def load_tables() -> str:
    """Worst-case tables: each message, the number of robots that fit, and the bus load by number of robots."""
    return f"{_message_table()}\n{_fit_table()}\n{_share_table()}"


def _fit_table() -> str:
    head = ["bit rate", f"robots within {COMFORTABLE:.0%}", "robots at most"]
    rows = [[_rate(rate), _fitting(COMFORTABLE * rate), _fitting(rate)] for rate in BIT_RATES]
    return _table([head, *rows])


def _fitting(bits_a_second: float) -> str:
    """How many robots fit, in general and if they use all messages."""
    return _with_brackets(str(min(NODE_MAX, int(bits_a_second / bits))) for bits in _robot_bits())


def _share_table() -> str:
    head = ["robots", *map(_rate, BIT_RATES)]
    rows = [[str(robots), *(_share(robots, rate) for rate in BIT_RATES)] for robots in range(1, NODE_MAX + 1)]
    return _table([head, *rows])


def _share(robots: int, rate: int) -> str:
    return _with_brackets(f"{robots * bits / rate:.0%}" for bits in _robot_bits())


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
    ]
    return _table([head, *rows, ["a robot", "", "", "", _with_brackets(map(_kbit, _robot_bits()))]])


def _regular(message: Message) -> list[str]:
    rate = frames_a_second(message)
    return [f"{rate:g}", _kbit(rate * worst_bits(message.length))] if rate else ["as needed", ""]


def measured_text(load: MeasuredLoad) -> str:
    """Measured traffic: a table of the messages, and a sentence with the bus load."""
    table = _table([_MEASURED_HEAD, *(_measured_row(load, name) for name in MESSAGES if name in load.messages)])
    if not load.seconds:
        return f"{table}\nThe log has no times.\n"
    shares = ", ".join(f"{load.bits_a_second / rate:.1%} at {_rate(rate)}" for rate in BIT_RATES)
    worst = robot_bits_a_second(optional=any(name in load.messages for name in OPTIONAL)) * len(load.nodes)
    return (
        f"{table}\n{len(load.nodes)} robot{'s' * (len(load.nodes) > 1)} in {load.seconds:.2f} s: "
        f"{_kbit(load.bits_a_second)} kbit/s, at worst {_kbit(worst)}.\nShare of the bus: {shares}.\n"
    )


_MEASURED_HEAD = ["message", "frames", "frames a second", "bits a frame", "at worst", "kbit/s"]


def _measured_row(load: MeasuredLoad, name: str) -> list[str]:
    share = load.messages[name]
    averages = [f"{share.bits / share.frames:.1f}", f"{share.worst / share.frames:.1f}"]
    if not load.seconds:
        return [name, str(share.frames), "", *averages, ""]
    rate = share.frames / load.seconds
    return [name, str(share.frames), f"{rate:.1f}", *averages, _kbit(share.bits / load.seconds)]


def _table(rows: list[list[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [f"| {' | '.join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))} |" for row in rows]
    lines.insert(1, f"| {' | '.join('-' * width for width in widths)} |")
    return "\n".join(lines) + "\n"


def _rate(bits: int) -> str:
    return f"{bits // 1000} kbit/s"


def _kbit(bits: float) -> str:
    return f"{bits / 1000:.2f}"
