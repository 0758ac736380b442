"""Invariants of every frame of a robot, whatever it answers."""

from collections.abc import Iterator, Sequence
from functools import cache
from typing import NamedTuple

import cantools
from cantools.database.can import Database
from cantools.database.can.signal import Signal

from host_sim.lab.check.talk import Said
from host_sim.protocol.codec import COUNTERS, DBC, crc8
from host_sim.protocol.generated import MESSAGES

_ALIVE = ("EMERGENCY", "MEMORY", "HEARTBEAT", "BOOT", "FAULTS", "CRASH", "HEALTH")
_PARTS = {"MEMORY": "half", "FAULTS": "page"}


class Breach(NamedTuple):
    """A frame that breaks a sentence.

    Attributes:
        number: Number of the sentence.
        why: Description of the fault.
        said: The frame.
    """

    number: str
    why: str
    said: Said


def rows() -> dict[str, str]:
    """The tables' descriptions of the signals that a robot sends, by MESSAGE.signal."""
    return {name: signal.comment or "" for name, signal in _signals().items()}


@cache
def _signals() -> dict[str, Signal]:
    database = cantools.database.load_file(DBC)
    assert isinstance(database, Database)
    sent = [message for message in database.messages if MESSAGES[message.name].sender == "ROBOT"]
    return {f"{message.name}.{signal.name}": signal for message in sent for signal in message.signals}


def breaches(heard: Sequence[Said]) -> Iterator[Breach]:
    """Yields the breaches in the frames of a talk."""
    signals, before = _signals(), dict[str, Said]()
    for said in heard:
        if said.by_robot:
            yield from (Breach(number, why, said) for number, why in _breaches_alone(said, signals))
            if said.name in _ALIVE and said.signals:
                last, before[said.name] = before.get(said.name), said
                if last is not None and not _goes_on(last, said):
                    yield Breach("P1", f"the counter of {said.name} does not go on by one", said)


def _breaches_alone(said: Said, signals: dict[str, Signal]) -> Iterator[tuple[str, str]]:
    if not said.name or MESSAGES[said.name].sender != "ROBOT":
        yield "B1", "it is no frame that a robot of this node sends"
        return
    if not said.signals:
        yield "B3", f"{said.name} has {len(said.frame.data)} bytes"
        return
    if said.frame.data[0] != crc8(*said.frame):
        yield "B8", "its CRC is wrong"
    if said.signals["counter"] >= COUNTERS:
        yield "P1", f"its counter is {said.signals['counter']}"
    if _unused(said):
        yield "B7", "bits without a signal are set"
    for name, value in said.signals.items():
        if not _is_in_range(value, signals[f"{said.name}.{name}"]) and name != "counter":
            yield f"{said.name}.{name}", f"{name} is {value}"


def _is_in_range(value: int, signal: Signal) -> bool:
    if signal.choices and signal.name not in ("opcode", "profile"):  # an unknown value is echoed as received
        return value in signal.choices
    low, high = signal.minimum, signal.maximum
    return (low is None or value >= low) and (high is None or value <= high)


def _unused(said: Said) -> bool:
    used = 0
    for signal in MESSAGES[said.name].signals:
        if signal.name in said.signals:
            used |= ((1 << signal.length) - 1) << signal.start
    return bool(int.from_bytes(said.frame.data, "little") & ~used)


def _goes_on(last: Said, said: Said) -> bool:
    """Whether the alive counter is one more; both parts of a pair share it, and frames in silence repeat the last."""
    ahead = (said.signals["counter"] - last.signals["counter"]) % COUNTERS
    if said.signals.get("silent") or last.signals.get("silent"):
        return ahead in (0, 1)
    is_second = said.name in _PARTS and said.signals[_PARTS[said.name]] == 1
    return ahead == (0 if is_second else 1)
