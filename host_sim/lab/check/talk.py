"""A talk with a robot that may be faulty: all frames are kept, whatever their CRC; and the registry of checks."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple, NoReturn

from host_sim.protocol.codec import COUNTERS, MessageLayout, Protocol
from host_sim.protocol.generated import (
    MESSAGES,
    ODOMETER_COUNTS_PER_MM,
    ODOMETER_SPAN,
    TICK_SPAN,
    Fault,
    Opcode,
    Reason,
    Result,
    Senses,
)
from host_sim.transport.link import Clock, Frame, Link

ANSWER_S = 0.9
"""Maximum time of an answer, even on a busy machine; after a second, a HEARTBEAT may come unrequested."""

_TICK_S, _QUEUE_MAX = 0.02, 100
_LAYOUTS = {name: MessageLayout(message) for name, message in MESSAGES.items()}


class BrokenError(Exception):
    """The robot breaks a sentence of the protocol; the message says what it did."""


class SeenFrame(NamedTuple):
    """A frame of the talk.

    Attributes:
        at_s: Time on the talk's clock, s.
        frame: The frame.
        name: Name of the message; empty for a frame that no robot may send.
        signals: Its signals; empty if its length is wrong.
        by_robot: Whether the robot has sent it.
    """

    at_s: float
    frame: Frame
    name: str
    signals: dict[str, int]
    by_robot: bool = True

    @property
    def is_answer(self) -> bool:
        """Whether it answers senses: a whole DRIVE not caused by silence."""
        return self.name == "DRIVE" and self.signals.get("reason", Reason.SILENCE) != Reason.SILENCE


class ReportedValues(dict[str, int]):
    """Reported values by signal; a signal missing from all reports is the robot's fault."""

    def __missing__(self, name: str) -> NoReturn:
        raise BrokenError(f"no report has {name}")


@dataclass
class Talk:
    """One sender's talk with a robot, from its power-up on.

    Attributes:
        link: The link to the robot.
        clock: The clock of the talk.
        protocol: The protocol of its node.
        hang: Suspends the robot for some ms, unnoticed by it; None if impossible.
        frames: All frames so far, of both sides.
    """

    link: Link
    clock: Clock
    protocol: Protocol = field(default_factory=Protocol)
    hang: Callable[[int], None] | None = None
    frames: list[SeenFrame] = field(default_factory=list)
    tick: int = -1
    counter: int = 0
    _odometers: list[int] = field(default_factory=lambda: [0, 0])

    def __post_init__(self) -> None:
        self._names = {self.protocol.id_of(name): name for name in MESSAGES}

    def send(self, frame: Frame) -> Frame:
        """Sends any frame."""
        self.frames.append(self._read(frame, by_robot=False))
        self.link.send(frame)
        return frame

    def hear(self, span_s: float, until: Callable[[SeenFrame], bool] = lambda _: False) -> list[SeenFrame]:
        """Frames of the robot within a span, or up to and including the first for which `until` is true."""
        end, first = self.clock.now() + span_s, len(self.frames)
        while (left_s := end - self.clock.now()) >= 0:
            frame = self.clock.receive(self.link, left_s)
            if frame is None:
                break
            self.frames.append(self._read(frame))
            if until(self.frames[-1]):
                break
        return self.frames[first:]

    def command(self, opcode: int, owner: int = 1, ahead: int = 1, **signals: int) -> list[SeenFrame]:
        """Sends a command with the next counter; returns the robot's frames up to its ANSWER."""
        self.counter = (self.counter + ahead) % COUNTERS
        self._hear_before()
        self.send(self.order(opcode, owner=owner, **signals))
        return self.hear(ANSWER_S, lambda seen: seen.name == "ANSWER")

    def _hear_before(self) -> None:
        """Receives unrequested frames such as HEARTBEAT, lest they be taken for answers to the next command."""
        for _ in range(_QUEUE_MAX):
            frame = self.clock.receive(self.link, 0.0)
            if frame is None:
                break
            self.frames.append(self._read(frame))

    def order(self, opcode: int, **signals: int) -> Frame:
        """The frame of a command."""
        fields = {signal.name: 0 for signal in MESSAGES["COMMAND"].signals}
        return self.protocol.encode("COMMAND", {**fields, "counter": self.counter, "opcode": opcode, **signals})

    def result(self, opcode: int, owner: int = 1, **signals: int) -> SeenFrame:
        """Sends a command; returns its ANSWER.

        Raises:
            BrokenError: There is none.
        """
        return one(self.command(opcode, owner, **signals), "ANSWER")

    def start(self, *, lockstep: int = 1, owner: int = 1) -> None:
        """Starts the robot; the tick before the first one is -1."""
        self.result(Opcode.START, owner, lockstep=lockstep, seed=1)
        self.tick = -1

    def drive_once(self, *, lockstep: int = 1, owner: int = 1) -> None:
        """Starts the robot and takes it through its first tick."""
        self.start(lockstep=lockstep, owner=owner)
        self.drive()

    def stop(self, owner: int = 1) -> list[SeenFrame]:
        """Stops the robot; returns its frames up to its DRIVE."""
        return [*self.command(Opcode.STOP, owner), *self.hear(ANSWER_S, lambda seen: seen.is_answer)]

    def report(self, owner: int = 1) -> dict[str, int]:
        """Requests all reports of the robot; returns their values by signal.

        Raises:
            BrokenError: The robot does not answer.
        """
        seen = self.command(Opcode.REPORT, owner) + self.hear(ANSWER_S, lambda seen: seen.name == "HEALTH")
        one(seen, "HEALTH")
        return ReportedValues({name: value for each in seen for name, value in each.signals.items()})

    def senses(self, tick: int, feel: int = 0) -> Frame:
        """The senses of a tick, of a body whose wheels have followed the last drive."""
        known = Senses(tick % TICK_SPAN, feel, False, False, 0, *self._odometers)
        return self.protocol.encode_senses(known, tick % COUNTERS)

    def step(self, ahead: int = 1, feel: int = 0) -> list[SeenFrame]:
        """Sends the senses of a coming tick; returns the robot's frames up to its DRIVE."""
        self.tick += ahead
        self.send(self.senses(self.tick, feel))
        heard = self.hear(ANSWER_S, lambda seen: seen.is_answer)
        for drive in heard[-1:]:
            for i, side in enumerate(("left", "right")):
                rolled = round(drive.signals.get(side, 0) * _TICK_S * ODOMETER_COUNTS_PER_MM)
                self._odometers[i] = (self._odometers[i] + rolled) % ODOMETER_SPAN
        return heard

    def drive(self, ahead: int = 1, feel: int = 0) -> SeenFrame:
        """As `step`, but returns the DRIVE.

        Raises:
            BrokenError: There is none.
        """
        return answering(self.step(ahead, feel), f"SENSES of tick {self.tick % TICK_SPAN}")

    def lines(self, end: int, count: int) -> Iterator[str]:
        """So many frames before an index, for people."""
        for seen in self.frames[max(0, end - count) : end]:
            way = "robot" if seen.by_robot else "     "
            yield f"{seen.at_s - self.frames[0].at_s:8.3f} s {way} {self.protocol.describe(seen.frame)}"

    def _read(self, frame: Frame, *, by_robot: bool = True) -> SeenFrame:
        name = self._names.get(frame.id, "")
        is_whole = bool(name) and len(frame.data) == MESSAGES[name].length
        signals = _LAYOUTS[name].unpack(frame.data) if is_whole else {}
        return SeenFrame(self.clock.now(), frame, name, signals, by_robot)


def answering(heard: list[SeenFrame], what: str) -> SeenFrame:
    """Finds the DRIVE that answers senses.

    Raises:
        BrokenError: There is none.
    """
    expect(bool(heard) and heard[-1].is_answer, f"no DRIVE answers {what}")
    return heard[-1]


def one(heard: list[SeenFrame], name: str) -> SeenFrame:
    """Finds the last frame of a message.

    Raises:
        BrokenError: There is none.
    """
    for seen in reversed(heard):
        if seen.name == name and seen.signals:
            return seen
    raise BrokenError(f"no {name} came")


def expect(is_so: bool, otherwise: str) -> None:
    """Checks a condition.

    Raises:
        BrokenError: The condition is false.
    """
    if not is_so:
        raise BrokenError(otherwise)


def expect_of_another(talk: Talk, opcode: Opcode, wanted: Result, when: str) -> None:
    """Checks the result of another sender's command.

    Raises:
        BrokenError: It is another result.
    """
    result = talk.result(opcode, owner=2).signals["result"]
    expect(result == wanted, f"{when}, another sender's {opcode.name.lower()} gets result {result}")


Check = Callable[[Talk], None]

CHECKS: dict[str, Check] = {}
"""The checks by sentence number. Each gets a robot that was just powered up and has answered a first command."""

SECOND = 50
"""Ticks in a second."""

AT_ONCE_S = 0.05
"""Time after which a frame counts as missing, s; after a longer time, a robot on its own clock reports silence."""

REPORTS = ("HEARTBEAT", "BOOT", "MEMORY", "FAULTS", "HEALTH")
"""The messages of a whole report."""

_TRIES = 20


def sentence(number: str) -> Callable[[Check], Check]:
    """Registers a check."""

    def note(check: Check) -> Check:
        CHECKS[number] = check
        return check

    return note


def without_silence(talk: Talk, attempt: Check) -> None:
    """Makes an attempt in which no silence may occur; repeats it if this computer was so slow that one did.

    Raises:
        BrokenError: The attempt fails, or silence occurred each time.
    """
    for _ in range(_TRIES):
        first = len(talk.frames)
        broken = None
        try:
            attempt(talk)
        except BrokenError as error:
            broken = error
        if not any(_heard_silence(seen.signals) for seen in talk.frames[first:]):
            if broken is not None:
                raise broken
            return
    raise BrokenError("it heard silence at once, however soon the next SENSES came")


def _heard_silence(signals: Mapping[str, int]) -> bool:
    """Whether a robot reports silence: in a DRIVE, or in an EMERGENCY after the next SENSES."""
    return signals.get("reason") == Reason.SILENCE or bool(signals.get("kinds", 0) >> Fault.SILENCE & 1)


def damaged(frame: Frame) -> Frame:
    """A copy of a frame with a wrong CRC."""
    return Frame(frame.id, bytes([frame.data[0] ^ 0xFF]) + frame.data[1:])
