"""The state of a bus as a text table: a line for each robot, then the problems."""

from collections.abc import Sequence

from host_sim.lab.monitor.bus_watch import BusWatch
from host_sim.lab.monitor.robot_watch import RobotWatch
from host_sim.lab.table import aligned
from host_sim.protocol.generated import MESSAGES, SIDES

_HEAD = (
    "node", "state", "clock", "profile", "owner", "SENSES/s", "DRIVE/s", "other/s", "lost", "repeated", "damaged",
    "memory", "doing",
)  # fmt: skip
_RIGHT = [i for i, name in enumerate(_HEAD) if name not in ("state", "clock", "profile", "memory", "doing")]
_CHOICES = {(name, signal.name): signal.choices for name, message in MESSAGES.items() for signal in message.signals}


def lines_of(bus: BusWatch, name: str, now_s: float) -> list[str]:
    """The table of a bus with this name; `now_s` is the time since the monitor began."""
    kbit = bus.bitrate / 1000
    head = f"{name}   {now_s:.0f} s   {bus.frames} frames   load {bus.load(now_s):.1%} of {kbit:g} kbit/s"
    others = f"   foreign {bus.foreign}   errors {bus.errors}   missing here {bus.dropped}"
    robots = [robot for _, robot in sorted(bus.robots.items())]
    if not robots:
        return [head + others, "", "no robot is heard"]
    table = aligned([_HEAD, *(_row(robot, now_s) for robot in robots)], _RIGHT)
    return [head + others, "", *table, "", *(f"! {what}" for what in bus.wrong(now_s))]


def _row(robot: RobotWatch, now_s: float) -> Sequence[str]:
    rates = {name: message.rate(now_s) for name, message in robot.messages.items()}
    other = sum(rates.values()) - rates["SENSES"] - rates["DRIVE"]
    return (
        str(robot.node),
        _word(robot, "HEARTBEAT", "state"),
        _word(robot, "HEARTBEAT", "lockstep"),
        _word(robot, "HEARTBEAT", "profile"),
        _word(robot, "HEARTBEAT", "owner"),
        f"{rates['SENSES']:.1f}",
        f"{rates['DRIVE']:.1f}",
        f"{other:.1f}",
        *(str(robot.total(count)) for count in ("lost", "repeated", "damaged")),
        "".join(_cell(cell) for cell in robot.memory) or "?",
        _doing(robot),
    )


def _word(robot: RobotWatch, message: str, signal: str) -> str:
    number = robot.said(message, signal)
    return "?" if number is None else _CHOICES[message, signal].get(number, str(number))


def _cell(number: int) -> str:
    """A cell as one character: the first letter of its side."""
    if number == 0:
        return "."
    return SIDES[number][0] if number < len(SIDES) else "#"


def _doing(robot: RobotWatch) -> str:
    if not robot.messages["DRIVE"].frames:
        return "?"
    return f"{_word(robot, 'DRIVE', 'reason')} {robot.said('DRIVE', 'left')} {robot.said('DRIVE', 'right')}"
