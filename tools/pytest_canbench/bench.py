"""The bench: a device, the rest of its bus, and the faults of the frames between them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple, NoReturn

from host_sim.base.errors import LinkDownError, UsageError
from host_sim.transport.faulty_link import FaultyLink, Schedule
from host_sim.transport.link import Frame, Link
from host_sim.transport.rule import Rule, in_ranges
from host_sim.transport.socket_pair import EXTENDED

from .devices import Device
from .messages import Messages

_FRAMES = 12
_FAULTS = 20


class BenchError(AssertionError):
    """The device cannot continue, or never sent what the test asks for."""


class Heard(NamedTuple):
    """A message from the device.

    Attributes:
        at_ms: Time of arrival.
        name: Name of the message.
        signals: The value of each signal.
    """

    at_ms: int
    name: str
    signals: dict[str, float]


def _id_text(frame_id: int) -> str:
    """An identifier, as candump writes it."""
    return f"{frame_id & ~EXTENDED:08X}" if frame_id & EXTENDED else f"{frame_id:03X}"


class _Moment(float):
    """A time in s, rounded after each addition: 10 ms + 35 ms equals 45 ms."""

    def __add__(self, span_s: float) -> "_Moment":
        return _Moment(round(float(self) + span_s, 6))


class _Time:
    """The bench's simulated time, as a clock for the link: waiting takes no time."""

    def __init__(self) -> None:
        self.now_ms = 0

    def now(self) -> float:
        """As in `Clock`."""
        return _Moment(self.now_ms / 1000)

    def receive(self, link: Link, timeout_s: float) -> Frame | None:  # noqa: ARG002 - as in `Clock`
        """As in `Clock`."""
        return link.receive(0.0)


@dataclass(frozen=True)
class Setup:
    """The configuration of a bench.

    Attributes:
        messages: The messages of the bus.
        open_device: Powers up a device and returns it.
        rules: The fault rules.
        seed: Seed of all that is random in the faults.
        node: The device's name in the DBC file: the bench sends all cyclic messages of other nodes. Empty: it
            sends only what the test names.
    """

    messages: Messages
    open_device: Callable[[], Device]
    rules: Sequence[str] = ()
    seed: int = 1
    node: str = ""


class Bench:
    """The bench that a test gets as `can_bench`.

    Attributes:
        heard: All messages from the device.
        damaged: Number of frames from the device with a wrong CRC or length.
        setup: Its configuration.
    """

    def __init__(self, setup: Setup) -> None:
        """Powers the device up.

        Raises:
            UsageError: The setup names something that does not exist.
        """
        self.setup = setup
        self._device: Device | None = None
        self.restart([Rule.parse(text) for text in setup.rules])

    def restart(self, rules: Sequence[Rule]) -> None:
        """Restarts at 0 ms with these faults and a newly powered-up device."""
        self.close()
        schedule = Schedule(rules, self.setup.seed, self.setup.messages.forger)
        self._time = _Time()
        self.heard: list[Heard] = []
        self.damaged = 0
        self._frames: list[tuple[int, str, Frame]] = []
        self._cyclic: dict[str, dict[str, float | str]] = {}
        if self.setup.node:
            self._cyclic = {name: {} for name in self.setup.messages.senders_of(self.setup.node)}
        self._device = self.setup.open_device()
        self._link = FaultyLink(self._device, schedule, self._time)

    @property
    def device(self) -> Device:
        """The device under test."""
        assert self._device is not None
        return self._device

    @property
    def now_ms(self) -> int:
        """The bench's time."""
        return self._time.now_ms

    @property
    def faults(self) -> list[Rule]:
        """The faults that have happened, each with its frames."""
        return list(in_ranges(self._link.schedule.struck))

    def send(self, name: str, **signals: float | str) -> None:
        """Sends a message once, now; a value may be one of the names that the DBC file has for it."""
        self.setup.messages.check(name, signals)
        self._send(name, signals)

    def send_cyclic(self, name: str, **signals: float | str) -> None:
        """From now on sends a message with these values at its GenMsgCycleTime."""
        self.setup.messages.check(name, signals)
        if not self.setup.messages[name].cycle_time:
            raise UsageError(f"{name} has no GenMsgCycleTime in {self.setup.messages.file}: use send")
        self._cyclic[name] = {**self._cyclic.get(name, {}), **signals}

    def silence(self, name: str) -> None:
        """Stops sending a message."""
        self._cyclic.pop(name, None)

    def run(self, ms: int) -> None:
        """Lets time pass.

        Raises:
            BenchError: The device has ended.
            UsageError: ms is negative.
        """
        __tracebackhide__ = True
        if ms < 0:
            raise UsageError(f"time does not pass backward: {ms} ms")
        for _ in range(ms):
            try:
                self._step()
            except LinkDownError as error:
                raise BenchError(f"after {self.now_ms} ms: {error}") from None
            self._time.now_ms += 1

    def run_until(self, signal: str, wanted: Callable[[float], object], ms: int) -> None:
        """Lets time pass until the last value of a signal from the device satisfies a condition.

        Raises:
            BenchError: It did not within `ms`, or the device has ended.
        """
        __tracebackhide__ = True
        for _ in range(ms):
            if any(wanted(value) for _, value in self._values(signal)[-1:]):
                return
            self.run(1)
        raise BenchError(f"within {ms} ms {signal} was not as wanted; it was {self[signal]:g} in the end")

    def __getitem__(self, signal: str) -> float:
        """The last value from the device, as `can_bench["STATUS.speed"]`.

        Raises:
            BenchError: It has sent none yet.
        """
        __tracebackhide__ = True
        return self.history(signal)[-1][1]

    def history(self, signal: str) -> list[tuple[int, float]]:
        """All values that the device has sent, each with its time in ms.

        Raises:
            BenchError: It has sent none yet.
        """
        __tracebackhide__ = True
        return self._values(signal) or self._never_heard(signal)

    def _values(self, signal: str) -> list[tuple[int, float]]:
        __tracebackhide__ = True
        name, _, of = signal.partition(".")
        self.setup.messages.check_names(name, [of])
        return [(at_ms, signals[of]) for at_ms, said, signals in self.heard if said == name and of in signals]

    def close(self) -> None:
        """Switches the device off."""
        if self._device is not None:
            self._device.close()
        self._device = None

    def lines(self) -> Iterator[str]:
        """A readable summary of the faults and the latest frames."""
        faults = [str(rule) for rule in self.faults]
        yield f"{self._link.schedule.count} faults by {self.now_ms} ms: {', '.join(faults[:_FAULTS]) or 'none'}" + (
            f", and {len(faults) - _FAULTS} more" if len(faults) > _FAULTS else ""
        )
        for at_ms, way, frame in self._frames[-_FRAMES:]:
            yield f"{at_ms:8} ms {way:4} {_id_text(frame.id)}#{frame.data.hex().upper()} {self._content_of(frame)}"

    def _content_of(self, frame: Frame) -> str:
        try:
            told = self.setup.messages.decode(frame)
        except ValueError:
            return "damaged"
        if told is None:
            return ""
        return f"{told[0]} " + " ".join(f"{name}={value:g}" for name, value in told[1].items())

    def _never_heard(self, signal: str) -> NoReturn:
        __tracebackhide__ = True
        names = sorted({heard.name for heard in self.heard})
        but = ", ".join(names) or (f"{self.damaged} damaged frames" if self.damaged else "nothing")
        raise BenchError(f"in {self.now_ms} ms the device has sent no {signal}; it has sent {but}")

    def _send(self, name: str, signals: dict[str, float | str]) -> None:
        frame = self.setup.messages.frame(name, signals)
        self._frames.append((self.now_ms, "to", frame))
        self._link.send(frame)

    def _step(self) -> None:
        for name, signals in self._cyclic.items():
            if self.now_ms % (self.setup.messages[name].cycle_time or 1) == 0:
                self._send(name, signals)
        self.device.tick(self.now_ms)
        while (frame := self._link.receive(0.0)) is not None:
            self._hear(frame)

    def _hear(self, frame: Frame) -> None:
        self._frames.append((self.now_ms, "from", frame))
        try:
            told = self.setup.messages.decode(frame)
        except ValueError:
            self.damaged += 1
            return
        if told is not None:
            self.heard.append(Heard(self.now_ms, *told))
