"""The frames of all nodes: sender and contents of each."""

from typing import NamedTuple

from host_sim.protocol.codec import NODE_MAX, Frame, Protocol
from host_sim.protocol.generated import MESSAGES


class Heard(NamedTuple):
    """One frame from a robot or to one.

    Attributes:
        node: The robot's node number.
        name: The message.
        signals: The raw number of each signal; None if the frame is damaged: its CRC or its length is wrong.
    """

    node: int
    name: str
    signals: dict[str, int] | None


_OWNERS = {
    protocol.id_of(name): (protocol, name)
    for protocol in (Protocol(node) for node in range(1, NODE_MAX + 1))
    for name in MESSAGES
}

IDS = frozenset(_OWNERS)
"""Every identifier that a message of some node has."""


def hear(frame: Frame) -> Heard | None:
    """Whose frame it is, and what it says; None if its identifier belongs to no message of any node."""
    owner = _OWNERS.get(frame.id)
    if owner is None:
        return None
    protocol, name = owner
    decoded = protocol.decode(frame)
    return Heard(protocol.node, name, None if decoded is None else decoded.signals)
