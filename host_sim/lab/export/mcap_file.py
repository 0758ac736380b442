"""Messages as MCAP, the format of Foxglove and ROS 2.

Each message of each robot has a topic, such as /robot_1/SENSES. A message is JSON: the raw value of each signal by
name, and the name of the value if it has one.
"""

import json
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path
from typing import Any

from host_sim.base.extra_library import library
from host_sim.protocol.every_node import Heard, hear
from host_sim.protocol.generated import MESSAGES
from host_sim.recording.log_text import Recorded

DAMAGED = "damaged"
"""The topic of frames with a wrong CRC or length."""

_WORD = "_name"
"""Suffix of a signal's name for the name of its value."""

_CHOICES = {
    name: {signal.name: signal.choices for signal in message.signals if signal.choices}
    for name, message in MESSAGES.items()
}


def write_mcap(path: Path, frames: Iterable[Recorded]) -> None:
    """Writes frames as MCAP."""
    with path.open("wb") as file:
        writer = library("mcap.writer", "export").Writer(file)
        writer.start(profile="", library="octet")
        channel_of = _channels(writer)
        for number, (time_us, frame) in enumerate(frames):
            heard = hear(frame)
            if heard is not None:
                writer.add_message(
                    channel_id=channel_of(heard.node, DAMAGED if heard.signals is None else heard.name),
                    log_time=time_us * 1000,
                    publish_time=time_us * 1000,
                    sequence=number,
                    data=json.dumps(_said(heard, frame.data)).encode("ascii"),
                )
        writer.finish()


def _channels(writer: Any) -> Callable[[int, str], int]:
    """Returns a function that finds the channel of a node's message; each is registered with its first message."""

    @cache
    def schema(name: str) -> int:
        text = json.dumps({"type": "object", "properties": _properties(name)})
        number: int = writer.register_schema(name=name, encoding="jsonschema", data=text.encode("ascii"))
        return number

    @cache
    def channel(node: int, name: str) -> int:
        topic = f"/robot_{node}/{name}"
        number: int = writer.register_channel(topic=topic, message_encoding="json", schema_id=schema(name))
        return number

    return channel


def _properties(name: str) -> dict[str, dict[str, str]]:
    if name == DAMAGED:
        return {"message": {"type": "string"}, "data": {"type": "string"}}
    signals = MESSAGES[name].signals
    numbers = {signal.name: {"type": "integer"} for signal in signals}
    return numbers | {f"{signal.name}{_WORD}": {"type": "string"} for signal in signals if signal.choices}


def _said(heard: Heard, data: bytes) -> dict[str, int | str]:
    if heard.signals is None:
        return {"message": heard.name, "data": data.hex().upper()}
    choices = _CHOICES[heard.name]
    words = {
        f"{name}{_WORD}": choices[name][number]
        for name, number in heard.signals.items()
        if number in choices.get(name, {})
    }
    return heard.signals | words
