"""A connection to a robot, and waiting for its frames."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

from host_sim.client.inbox import Inbox
from host_sim.protocol.codec import Frame
from host_sim.protocol.generated import Senses
from host_sim.transport.link import LineStats, Link
from host_sim.world.body import Body

DEADLINE_S = 5.0
"""Time after which the client gives up on a robot that does not answer, s of wall-clock time."""


@dataclass(frozen=True)
class Connection:
    """A connection to a robot.

    Attributes:
        link: Carries frames to the robot and back.
        bus: Name of the bus, as in the summary.
        status: Describes the state of the robot's process, and raises RobotError if it has ended.
        printed: The complete lines that its program has printed, of its first 4095 bytes; empty if it has no program.
        pid: Process id of the robot; None if it was not started as a process.
        line: Statistics of the line below the frames.
        deadline_s: Time after which the client gives up on a silent robot, s of wall-clock time.
        answers_at_once: Whether the robot answers within `send`, or not at all.
        now: Returns the time by which the link's timeouts are measured, s.
        sense: For a robot with sensors of its own: computes its senses from its body, the world's senses and
            the number of the tick; None for all others.
        pins: Reads such a robot's pins, as `RobotOnPins.figures`.
    """

    link: Link
    bus: str = ""
    status: Callable[[], str] = lambda: "was not started here"
    printed: Callable[[], str] = str
    pid: int | None = None
    line: LineStats = field(default_factory=LineStats)
    deadline_s: float = DEADLINE_S
    answers_at_once: bool = False
    now: Callable[[], float] = time.monotonic
    sense: Callable[[Body, Senses, int], Senses] | None = None
    pins: Callable[[], dict[str, Any]] | None = None


T = TypeVar("T")

_LOOK_ALIVE_S = 0.2
_REPEAT_S = 0.05
_STRETCH_MAX = 16
_DUST_S = 1e-6
_WAITING_MAX = 64
_MEANS = 4
_LEAST_S, _MOST_S = 0.01, 0.25
_FIRST_S = 0.2
# `_MOST_S` would be short for a network, where retries add load; on a bus, one more frame does no harm.
_GAIN, _VARIATION_GAIN = 1 / 8, 1 / 4
_VARIATIONS = 4


class RoundTrip:
    """Estimates the round-trip time as RFC 6298 does for TCP: smoothed, with its variation, doubled after a timeout.

    >>> trip = RoundTrip()
    >>> trip.sample(0.05)
    >>> round(trip.timeout_s, 3)
    0.15

    Attributes:
        timeout_s: Time after which an answer is considered lost, s.
        is_sure: Whether no answer was late since the last sample.
        mean_s: Recent mean time from a frame to its answer, s; None before the first.
    """

    def __init__(self) -> None:
        """Starts without samples."""
        self.timeout_s = _FIRST_S
        self.is_sure = False
        self.mean_s: float | None = None
        self._smoothed_s: float | None = None
        self._variation_s = 0.0

    def sample(self, seconds: float) -> None:
        """Adds the answer time of a frame that was sent once; with repetitions it would be ambiguous."""
        self.is_sure = True
        if self._smoothed_s is None:
            self._smoothed_s, self._variation_s = seconds, seconds / 2
        else:
            self._variation_s += _VARIATION_GAIN * (abs(seconds - self._smoothed_s) - self._variation_s)
            self._smoothed_s += _GAIN * (seconds - self._smoothed_s)
        self.timeout_s = min(max(self._smoothed_s + _VARIATIONS * self._variation_s, _LEAST_S), _MOST_S)
        self.note(seconds)

    def note(self, seconds: float) -> None:
        """Adds an answer time to the mean, repetitions included."""
        self.mean_s = seconds if self.mean_s is None else self.mean_s + _GAIN * (seconds - self.mean_s)

    def back_off(self) -> None:
        """Doubles the timeout, until a frame that was sent once is answered."""
        self.is_sure = False
        self.timeout_s = min(2 * self.timeout_s, _MOST_S)


@dataclass(frozen=True)
class Waiting:
    """Receives frames until the awaited one arrives.

    Attributes:
        connection: Carries the frames, and raises RobotError if the robot's process has ended.
        round_trip: Estimates the answer time.
        inbox: Counts repeated frames and repeated answers.
    """

    connection: Connection
    round_trip: RoundTrip
    inbox: Inbox

    def receive(self, take: Callable[[Frame], T | None], timeout_s: float) -> T | None:
        """Returns the first result of `take` that is not None; None after the timeout.

        Only time spent waiting counts, not that of a stalled host or a lost line.
        """
        left_s, spare = timeout_s, _WAITING_MAX
        while True:
            asked_s, before_s = min(left_s, _LOOK_ALIVE_S), self.connection.now()
            frame = self.connection.link.receive(asked_s)
            if frame is None:
                self.connection.status()
            elif (result := take(frame)) is not None:
                return result
            left_s = max(left_s - min(self.connection.now() - before_s, asked_s), 0.0)
            spare -= left_s <= _DUST_S  # frames already waiting are processed, even if this host was stalled
            if left_s <= _DUST_S and (frame is None or not spare):
                return None

    def receive_or_repeat(
        self, repeat: Callable[[], None], take: Callable[[Frame], T | None], timeout_s: float
    ) -> T | None:
        """As `receive`, for an answer: if it takes too long, `repeat` sends the request again.

        While a robot works through earlier repetitions, further ones would only delay it. So the pauses double, and
        the timeout starts over, a few times at most. On a noisy line the number of copies doubles instead of the
        pauses.
        """
        line, left_s, wait_s, stretch = self.connection.line, timeout_s, self._first_wait_s(), 1
        again, garbled = self.inbox.answered_again, line.garbled
        while True:
            result = self.receive(take, min(wait_s, left_s))
            left_s -= wait_s
            if result is not None or left_s <= 0:
                return result
            if line.garbled > garbled:
                garbled = line.garbled
                line.insist()
                repeat()
                continue
            repeat()
            if self.inbox.answered_again > again and stretch < _STRETCH_MAX:
                self.round_trip.back_off()
                left_s, stretch, again = timeout_s, 2 * stretch, self.inbox.answered_again
            wait_s = min(2 * wait_s, stretch * _REPEAT_S)

    def repeat(self, frame: Frame) -> None:
        """Sends a frame again, on a noisy line many times."""
        if self.round_trip.is_sure and not self.connection.line.noisy:
            self.round_trip.back_off()
        self.connection.link.send(frame)
        self.inbox.counts.repeated += self.connection.line.copies

    def _first_wait_s(self) -> float:
        """Time before the first repetition; on a noisy line, copies may be lost but are not delayed."""
        expected_s, mean_s = self.round_trip.timeout_s, self.round_trip.mean_s
        return min(expected_s, _MEANS * mean_s) if self.connection.line.noisy and mean_s else expected_s
