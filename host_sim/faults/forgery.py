"""Frames in another's name: any message with any content, whose CRC is true."""

from collections.abc import Callable
from random import Random

from host_sim.errors import UsageError
from host_sim.protocol.codec import COUNTERS, Frame, Protocol
from host_sim.protocol.generated import MESSAGES, Opcode, Signal


def forger(what: str, protocol: Protocol) -> Callable[[Random], Frame]:
    """A function that forges frames.

    Args:
        what: Name of a command, in small letters, or of a message; empty for any message.
        protocol: The protocol of the node that they are for.

    Raises:
        UsageError: There is no such command or message.
    """
    if what.upper() in Opcode.__members__ and what.islower():
        opcode = Opcode[what.upper()]
        return lambda dice: forge(protocol, "COMMAND", dice, opcode=opcode)
    if what and what not in MESSAGES:
        commands = ", ".join(name.lower() for name in Opcode.__members__)
        raise UsageError(f"no command or message {what!r} to forge; there are {commands}, {', '.join(MESSAGES)}")
    names = (what,) if what else tuple(MESSAGES)
    return lambda dice: forge(protocol, dice.choice(names), dice)


def forge(protocol: Protocol, name: str, dice: Random, **fixed: int) -> Frame:
    """A frame of a message with random content.

    Args:
        protocol: The protocol of the node that it is for.
        name: Name of the message.
        dice: Source of all that is random.
        **fixed: Signals that are not random.
    """
    signals = {signal.name: _any_number(signal, dice) for signal in MESSAGES[name].signals}
    return protocol.encode(name, {**signals, "counter": dice.randrange(COUNTERS), **fixed})


def _any_number(signal: Signal, dice: Random) -> int:
    span = 1 << signal.length
    return dice.randrange(span) - (span >> 1 if signal.signed else 0)
