"""The sentences of docs/protocol.md that specify a robot, and the invariants of every frame that it sends."""

import re
from collections.abc import Iterator, Sequence
from functools import cache
from typing import NamedTuple

import cantools
from cantools.database.can import Database
from cantools.database.can.signal import Signal

from host_sim.lab.check.talk import SeenFrame
from host_sim.protocol.codec import COUNTERS, DBC, crc8
from host_sim.protocol.generated import MESSAGES
from host_sim.report.protocol_page import page

NOT_CHECKED = {
    "B2": "a robot at another bit rate is not heard at all",
    "B4": "signals in other places fail nearly every other check",
    "B5": "no robot needs to drive backward; T9 and L3 read the speeds as they are",
    "B6": "T3, T7 and MEMORY choose by these",
    "H2": "H1, H4 and H5 compute it",
    "COMMAND": "T7 and L4 say the same",
    "DRIVE": "T9, L3 and S2 say the same",
    "SENSES": "what others send",
    "RANGES": "what others send",
    "ANSWER": "T7 says the same",
    "EMERGENCY": "P7 says the same",
    "HEARTBEAT": "T11 and S4 say the same",
    "BOOT": "T1 and T3 say the same",
    "FAULTS": "T11 and P6 say the same",
    "CRASH": "a crash would have to be made",
    "HEALTH": "T11 and H1 say the same",
}
"""Reasons why sentences have no check of their own."""

_MARK = re.compile(r"\(([A-Z]\d+)\)")
_SENTENCE = re.compile(r"(?<=\.) (?=[A-Z*`])|(?:^| )\d\. ")
_FIRST, _END = "\n## A conversation\n", "\n## Identifiers\n"


_page = cache(page)


def prose() -> Iterator[str]:
    """Yields the sentences of the page's prose about the conversation on the bus."""
    text = _page()
    for block in text[text.index(_FIRST) : text.index(_END)].split("\n\n"):
        if not block.lstrip().startswith("#"):
            yield from filter(None, _SENTENCE.split(" ".join(block.split())))


@cache
def sentences() -> dict[str, str]:
    """The specification by sentence number, by message name, and by MESSAGE.signal of a robot's messages."""
    found = {}
    for text in prose():
        begin = 0
        for mark in _MARK.finditer(text):
            found[mark[1]] = text[begin : mark.start()].strip(" ,.;:()").removeprefix("and ")
            begin = mark.end()
    comments = re.findall(r"\n## ([A-Z]+)\n\n(.+)\n", _page())
    return {**found, **{name: comment for name, comment in comments if name in MESSAGES}, **rows()}


_ALIVE = ("EMERGENCY", "MEMORY", "HEARTBEAT", "BOOT", "FAULTS", "CRASH", "HEALTH")
_PARTS = {"MEMORY": "half", "FAULTS": "page"}


class Breach(NamedTuple):
    """A frame that breaks a sentence.

    Attributes:
        number: Number of the sentence.
        why: Description of the fault.
        seen: The frame.
    """

    number: str
    why: str
    seen: SeenFrame


def rows() -> dict[str, str]:
    """The tables' descriptions of the signals that a robot sends, by MESSAGE.signal."""
    return {name: signal.comment or "" for name, signal in _signals().items()}


@cache
def _signals() -> dict[str, Signal]:
    database = cantools.database.load_file(DBC)
    assert isinstance(database, Database)
    sent = [message for message in database.messages if MESSAGES[message.name].sender == "ROBOT"]
    return {f"{message.name}.{signal.name}": signal for message in sent for signal in message.signals}


def breaches(heard: Sequence[SeenFrame]) -> Iterator[Breach]:
    """Yields the breaches in the frames of a talk."""
    signals, before = _signals(), dict[str, SeenFrame]()
    for seen in heard:
        if seen.by_robot:
            yield from (Breach(number, why, seen) for number, why in _breaches_alone(seen, signals))
            if seen.name in _ALIVE and seen.signals:
                last, before[seen.name] = before.get(seen.name), seen
                if last is not None and not _goes_on(last, seen):
                    yield Breach("P1", f"the counter of {seen.name} does not go on by one", seen)


def _breaches_alone(seen: SeenFrame, signals: dict[str, Signal]) -> Iterator[tuple[str, str]]:
    if not seen.name or MESSAGES[seen.name].sender != "ROBOT":
        yield "B1", "it is no frame that a robot of this node sends"
        return
    if not seen.signals:
        yield "B3", f"{seen.name} has {len(seen.frame.data)} bytes"
        return
    if seen.frame.data[0] != crc8(*seen.frame):
        yield "B8", "its CRC is wrong"
    if seen.signals["counter"] >= COUNTERS:
        yield "P1", f"its counter is {seen.signals['counter']}"
    if _unused(seen):
        yield "B7", "bits without a signal are set"
    for name, value in seen.signals.items():
        if not _is_in_range(value, signals[f"{seen.name}.{name}"]) and name != "counter":
            yield f"{seen.name}.{name}", f"{name} is {value}"


def _is_in_range(value: int, signal: Signal) -> bool:
    if signal.choices and signal.name not in ("opcode", "profile"):  # an unknown value is echoed as received
        return value in signal.choices
    low, high = signal.minimum, signal.maximum
    return (low is None or value >= low) and (high is None or value <= high)


def _unused(seen: SeenFrame) -> bool:
    used = 0
    for signal in MESSAGES[seen.name].signals:
        if signal.name in seen.signals:
            used |= ((1 << signal.length) - 1) << signal.start
    return bool(int.from_bytes(seen.frame.data, "little") & ~used)


def _goes_on(last: SeenFrame, seen: SeenFrame) -> bool:
    """Whether the alive counter is one more; both parts of a pair share it, and frames in silence repeat the last."""
    ahead = (seen.signals["counter"] - last.signals["counter"]) % COUNTERS
    if seen.signals.get("silent") or last.signals.get("silent"):
        return ahead in (0, 1)
    is_second = seen.name in _PARTS and seen.signals[_PARTS[seen.name]] == 1
    return ahead == (0 if is_second else 1)
