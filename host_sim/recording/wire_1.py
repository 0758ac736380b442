"""Logs of wire 1, the previous message layout: each frame is converted to one or more frames of the current layout.

Fields missing from wire 1 are filled in: running alive counters, an owner, the reason for a rest in silence. Damaged
frames, and those with an unknown command, cannot be converted and are left out.
"""

import re
from collections import Counter
from collections.abc import Iterator
from typing import Any

from host_sim.base.errors import UsageError
from host_sim.protocol.codec import COUNTERS, NODE_MAX, Frame, MessageLayout, Protocol, crc8
from host_sim.protocol.generated import CELL_COUNT, LAYOUT_HASH, TICK_SPAN, Message, Opcode, Reason, Signal
from host_sim.recording.log_files import frames_in
from host_sim.recording.log_reader import FOREIGN, WIRE_1_LAYOUTS, LogReader
from host_sim.recording.log_text import Recorded

DAMAGED = "damaged"
"""The kind of damaged frames, and of those with another layout than wire 1."""

_TICKS = 4096
_OWNER = 1
_HALF = CELL_COUNT // 2
_SIDE_BITS = 2

# Each line: identifier for node 1, length, message, then for each signal its name, @ the opcode that selects it,
# its first bit and its length, negative if it is signed.
_TABLE = """
041 8 COMMAND crc:0:8 counter:8:4 opcode:12:4 lockstep:16:1 profile@2:24:8 seed@2:32:32 parameter@4:24:8 \
value@4:32:16 mask@5:24:8 cells@5:32:16 freeze@7:24:1
081 8 DRIVE crc:0:8 tick:8:12 reason:20:4 left:24:-12 right:36:-12 repeat_count:48:8 eat:56:1 action:57:7
0C1 8 SENSES crc:0:8 tick:8:12 feel:20:5 bump:25:1 look:26:1 beacon:27:13 odometer_left:40:12 odometer_right:52:12
101 3 ANSWER crc:0:8 counter:8:4 opcode:12:4 result:16:8
141 8 MEMORY cell_0:0:8 cell_1:8:8 cell_2:16:8 cell_3:24:8 cell_4:32:8 cell_5:40:8 cell_6:48:8 cell_7:56:8
181 8 HEARTBEAT state:0:2 frozen:2:1 lockstep:3:1 profile:4:4 faults:8:8 uptime:16:16 version_major:32:8 \
version_minor:40:8 dbc_hash:48:16
1C1 8 FAULTS silences:0:8 missed:8:8 stale:16:8 damaged:24:8 foreign:32:8 unsent:40:8 refused:48:8 unsaved:56:8
201 8 HEALTH reset_cause:0:3 bus_state:3:2 modified:5:1 tx_errors:8:8 rx_errors:16:8 bus_offs:24:8 dropped:32:8 \
commit:40:24
241 6 CRASH cause:0:8 name:8:8 value:16:32
"""
_SIGNAL = re.compile(r"(\w+)(?:@(\d))?:(\d+):(-?\d+)")
_PROTECTED = frozenset(("COMMAND", "DRIVE", "SENSES", "ANSWER"))


def _message(line: str) -> Message:
    identifier, length, name, *signals = line.split()
    return Message(name, int(identifier, 16), int(length), "", 0, tuple(map(_signal, signals)))


def _signal(text: str) -> Signal:
    match = _SIGNAL.fullmatch(text)
    assert match is not None
    name, opcode, start, length = match.groups()
    return Signal(
        name, int(start), abs(int(length)), length[0] == "-", name == "opcode", (int(opcode),) if opcode else (), {}
    )


_MESSAGES = [_message(line) for line in _TABLE.strip().splitlines()]
_OWNERS = {message.id + node - 1: (node, message) for message in _MESSAGES for node in range(1, NODE_MAX + 1)}
_LAYOUTS = {message.name: MessageLayout(message) for message in _MESSAGES}


class OldLog(LogReader):
    """A log of wire 1, as if recorded with the current messages."""

    def __iter__(self) -> Iterator[Recorded]:
        """Yields frames of the current wire, in order.

        Raises:
            UsageError: The file cannot be read, or is not a log.
            UsageError: It is empty, damaged or cut short, or it has no HEARTBEAT of wire 1.
        """
        skipped = self.skipped = Counter()
        transcoder = Transcoder()
        for read in frames_in(self.path):
            if isinstance(read, str):
                skipped[read] += 1
            elif read.frame.id not in _OWNERS:
                skipped[FOREIGN] += 1
            elif (frames := transcoder.transcode(read)) is None:
                skipped[DAMAGED] += 1
            else:
                yield from frames
        if not transcoder.is_recognised:
            raise UsageError(f"{self.path} has no heartbeat of wire 1: it is not an old log, or is cut short")


class Transcoder:
    """Converts the frames of one log of wire 1, in order.

    Attributes:
        is_recognised: Whether a HEARTBEAT has identified the log as wire 1.
    """

    def __init__(self) -> None:
        self.is_recognised = False
        self._robots = {node: _Robot(node) for node in range(1, NODE_MAX + 1)}

    def transcode(self, recorded: Recorded) -> list[Recorded] | None:
        """The current frames equivalent to a frame of wire 1; None if it is damaged or not of wire 1."""
        signals = _decode(recorded.frame)
        if signals is None:
            return None
        node, message = _OWNERS[recorded.frame.id]
        self.is_recognised |= signals.get("dbc_hash") in WIRE_1_LAYOUTS
        return [Recorded(recorded.time_us, frame) for frame in self._robots[node].frames(message.name, signals)]


def _decode(frame: Frame) -> dict[str, int] | None:
    owner = _OWNERS.get(frame.id)
    if owner is None or len(frame.data) != owner[1].length:
        return None
    name = owner[1].name
    # CRC-8 SAE J1850: an initial value of 0xFF is equivalent to inverting the first byte.
    if name in _PROTECTED and frame.data[0] != crc8(frame.id ^ 0xFF, frame.data) ^ 0xFF:
        return None
    return _LAYOUTS[name].unpack(frame.data)


class _Robot:
    """Converts one robot's frames, and holds the state from one to the next."""

    def __init__(self, node: int) -> None:
        self._protocol = Protocol(node)
        self._counters: dict[str, int] = {}
        self._tick = 0
        self._stopped = True
        self._version = {"version_major": 0, "version_minor": 0}
        self._boot: dict[str, int] = {}

    def frames(self, name: str, signals: dict[str, int]) -> Iterator[Frame]:
        """Yields the current frames for a message of wire 1."""
        kept = {signal: number for signal, number in signals.items() if signal not in ("crc", "counter")}
        method: Any = getattr(self, f"_{name.lower()}")
        yield from method(kept)

    def _counted(self, name: str, /, **signals: int) -> Frame:
        """A message with the next value of its own counter."""
        counter = self._counters[name] = (self._counters.get(name, -1) + 1) % COUNTERS
        return self._protocol.encode(name, {"counter": counter, **signals})

    def _command(self, signals: dict[str, int]) -> Iterator[Frame]:
        opcode, lockstep = signals["opcode"], signals.pop("lockstep")
        self._stopped = opcode == Opcode.STOP or (self._stopped and opcode not in (Opcode.START, Opcode.RESUME))
        if opcode == Opcode.START:
            yield self._counted("COMMAND", owner=_OWNER, lockstep=lockstep, **signals)
        elif opcode == Opcode.WRITE:
            yield from self._write(signals["mask"], signals["cells"])
        elif opcode in set(Opcode):
            yield self._counted("COMMAND", owner=_OWNER, **signals)

    def _write(self, mask: int, cells: int) -> Iterator[Frame]:
        """Yields a WRITE for each half of the memory."""
        sides = [cells >> _SIDE_BITS * cell & 3 for cell in range(CELL_COUNT)]
        for half in range(2):
            content = {f"byte_{i}": side for i, side in enumerate(sides[half * _HALF : (half + 1) * _HALF])}
            part = mask >> half * _HALF & 15
            yield self._counted("COMMAND", opcode=Opcode.WRITE, owner=_OWNER, mask=part, half=half, **content)

    def _answer(self, signals: dict[str, int]) -> Iterator[Frame]:
        counter = self._counters.get("COMMAND", 0)
        yield self._protocol.encode("ANSWER", {"counter": counter, **signals, "which": 0, "value": 0})

    def _senses(self, signals: dict[str, int]) -> Iterator[Frame]:
        self._tick += (signals["tick"] - self._tick) % _TICKS
        yield self._of_tick("SENSES", self._tick, signals)

    def _drive(self, signals: dict[str, int]) -> Iterator[Frame]:
        answered = self._tick - (self._tick - signals["tick"]) % _TICKS
        if signals["reason"] == Reason.STOP and not self._stopped:
            signals["reason"] = Reason.SILENCE
        yield self._of_tick("DRIVE", answered, signals)

    def _of_tick(self, name: str, tick: int, signals: dict[str, int]) -> Frame:
        """A message whose counter advances with the tick."""
        counted = {"counter": tick % COUNTERS, "tick": tick % TICK_SPAN}
        return self._protocol.encode(name, {**signals, **counted})

    def _memory(self, signals: dict[str, int]) -> Iterator[Frame]:
        counter = self._counters["MEMORY"] = (self._counters.get("MEMORY", -1) + 1) % COUNTERS
        for half in range(2):
            yield self._protocol.encode("MEMORY", {"counter": counter, "half": half, **signals})

    def _heartbeat(self, signals: dict[str, int]) -> Iterator[Frame]:
        self._version = {name: signals.pop(name) for name in self._version}
        del signals["faults"], signals["dbc_hash"]
        owner = _OWNER if signals["state"] else 0
        yield self._counted("HEARTBEAT", silent=0, owner=owner, layout=LAYOUT_HASH, **signals)

    def _faults(self, signals: dict[str, int]) -> Iterator[Frame]:
        counter = self._counters["FAULTS"] = (self._counters.get("FAULTS", -1) + 1) % COUNTERS
        unknown = {"twins": 0, "contradictions": 0, "denied": 0}
        for page in range(2):
            yield self._protocol.encode("FAULTS", {"counter": counter, "page": page, **signals, **unknown})

    def _health(self, signals: dict[str, int]) -> Iterator[Frame]:
        boot = self._version | {name: signals.pop(name) for name in ("reset_cause", "modified", "commit")}
        if boot != self._boot:
            self._boot = boot
            yield self._counted("BOOT", **boot)
        yield self._counted("HEALTH", unstored=0, clock=1, held=0, **signals)

    def _crash(self, signals: dict[str, int]) -> Iterator[Frame]:
        yield self._counted("CRASH", **signals)
