"""Forged frames: any message with any content and a valid CRC."""

from collections.abc import Callable
from random import Random

from host_sim.base.errors import UsageError
from host_sim.protocol.codec import COUNTERS, DecodedFrame, Frame, Protocol
from host_sim.protocol.generated import CELL_COUNT, MESSAGES, PARAMETERS, PROFILES, TICK_SPAN, Opcode, Signal


class Forger:
    """Listens to a bus, and sends frames in another's name: commands and senses as the robot expects them."""

    def __init__(self, what: str, protocol: Protocol) -> None:
        """Starts with no frames heard.

        Args:
            what: Name of a command, in lower case, or of a message; empty for any message.
            protocol: The protocol of the node that they are for.

        Raises:
            UsageError: There is no such command or message.
        """
        self._protocol = protocol
        self._followed = {protocol.id_of(name) for name in ("COMMAND", "SENSES")}
        self._fixed: dict[str, int] = {}
        self._names = (what,) if what else tuple(MESSAGES)
        self._heard: dict[str, DecodedFrame] = {}
        if what.upper() in Opcode.__members__ and what.islower():
            self._names, self._fixed = ("COMMAND",), {"opcode": int(Opcode[what.upper()])}
        elif what and what not in MESSAGES:
            commands = ", ".join(name.lower() for name in Opcode.__members__)
            raise UsageError(f"no command or message {what!r} to forge; there are {commands}, {', '.join(MESSAGES)}")

    def hear(self, frame: Frame) -> None:
        """Notes a frame on the bus."""
        if frame.id in self._followed and (decoded := self._protocol.decode(frame)) is not None:
            self._heard[decoded.name] = decoded

    def forge(self, dice: Random) -> Frame:
        """A frame with random content.

        A command has the last sender's number and the next counter, so that the robot obeys it. Senses are those of
        the next tick, so that it takes them.
        """
        name, fixed = dice.choice(self._names), self._fixed
        if name in self._heard:
            told = self._heard[name].signals
            fixed = {**fixed, "counter": (told["counter"] + 1) % COUNTERS}
            if name == "SENSES":
                fixed["tick"] = (told["tick"] + 1) % TICK_SPAN
            else:
                fixed = {"opcode": dice.choice(tuple(Opcode)), **_content(dice), **fixed, "owner": told["owner"]}
        frame = forge(self._protocol, name, dice, **fixed)
        self.hear(frame)
        return frame


def forgers(protocol: Protocol) -> Callable[[str], Forger]:
    """Returns a factory of forgers for one node, with names as for `Forger`."""
    return lambda what: Forger(what, protocol)


def _content(dice: Random) -> dict[str, int]:
    """Signal values that a robot with a turn per pattern accepts in any command."""
    parameter, half = dice.choice(tuple(PARAMETERS.values())), dice.randrange(2)
    return {
        "profile": dice.randrange(len(PROFILES)),
        "parameter": parameter.number,
        "wanted": parameter.number,
        "value": dice.randint(parameter.minimum, parameter.maximum),
        "half": half,
        "mask": 14 + half,  # cell 0 stays empty
        **{f"byte_{i}": dice.randint(1, 2) for i in range(CELL_COUNT // 2)},
    }


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
