"""The board's time, `struct board_clock`, and the events scheduled on it."""

from collections.abc import Callable
from functools import partial
from typing import Any

from host_sim.emulator.c_models import c_models

SECOND = 10**15
"""Moments and spans are in whole femtoseconds, so that sums of clock periods do not drift."""

_NS = SECOND // 10**9
_HOUR = 3600 * SECOND

NEVER = (2**64 - 1) * _NS
"""A moment that never comes."""


class Clock:
    """Time, counted in cycles of the core, one per instruction, with timed events.

    Attributes:
        model: The C model, `struct board_clock`.
    """

    def __init__(self, hz: int) -> None:
        """Starts at 0.

        Args:
            hz: Core clock at power-up, Hz.

        Raises:
            OctetError: The models are not built.
        """
        self._ffi, self._library = ffi, _ = c_models()
        self._timed: list[Callable[[], int]] = []
        self._failure: BaseException | None = None
        self._take: Any = None
        self._alarms: Any = None
        self._ring_c = ffi.callback("void(struct board_clock *, unsigned)", self._ring, onerror=self.fail)
        self.model: Any = ffi.new("struct board_clock *")
        self.model.ring = self._ring_c
        self.model.period_fs = SECOND // hz
        self.model.horizon.ns = NEVER // _NS

    @property
    def now(self) -> int:
        """Time since power-up."""
        now = self.model.now
        moment: int = now.ns * _NS + now.fs
        return moment

    @property
    def cycles(self) -> int:
        """Cycles of the core since power-up."""
        cycles: int = self.model.cycles
        return cycles

    def add(self, due: Callable[[], int]) -> Callable[[int], None]:
        """Adds an event.

        Args:
            due: Handles the event, and returns the moment of its next call.

        Returns:
            Sets that moment if it changes. Until then, `due` is called as soon as any event is due.
        """
        self._timed.append(due)
        alarms = self._ffi.new("struct moment[]", len(self._timed))
        for number in range(self.model.alarm_count):
            alarms[number] = self._alarms[number]
        self._alarms = self.model.alarms = alarms
        self.model.alarm_count = len(self._timed)
        return partial(self._set_alarm, len(self._timed) - 1)

    def set_hz(self, hz: int) -> None:
        """Changes the core clock, Hz."""
        self.model.period_fs = SECOND // hz
        self.expect_now()

    def join_wire(self, wire: Any, take: Callable[[], None]) -> None:
        """Makes a bus advance with time.

        Args:
            wire: The C model, `struct can_wire`.
            take: Called when something was received from it, or a controller rejected something.
        """
        self._take = self._ffi.callback("void(struct board_clock *)", lambda _clock: take(), onerror=self.fail)
        self.model.wire, self.model.take = wire, self._take

    def expect(self, moment: int) -> None:
        """Notes that a new event is due at a moment."""
        self._library.clock_expect(self.model, divmod(min(moment, NEVER), _NS))

    def expect_now(self) -> None:
        """Notes that a new event is due at once."""
        self._library.clock_expect(self.model, self.model.now)

    def _set_alarm(self, number: int, moment: int) -> None:
        alarm = self._alarms[number]
        alarm.ns, alarm.fs = divmod(min(moment, NEVER), _NS)
        self._library.clock_expect(self.model, alarm)

    def _ring(self, _clock: object, number: int) -> None:
        self._set_alarm(number, self._timed[number]())

    def execute(self, cycles: int) -> None:
        """Advances time by a number of cycles, and runs all events that are due then."""
        self._library.clock_execute(self.model, cycles)
        self.raise_failure()

    def skip(self, span: int) -> None:
        """Advances time by a span while the core is idle, and stops at each event on the way."""
        moment = self.now + span
        while (now := self.now) < moment:
            ns, fs = divmod(min(moment, now + _HOUR), _NS)
            self._library.clock_skip_to(self.model, (ns, fs))
            self.raise_failure()

    def skip_to_event(self) -> None:
        """Advances time to the next event, by an hour at most."""
        self._library.clock_execute(self.model, 0)
        self._library.clock_skip_to_event(self.model, _HOUR // _NS)
        self.raise_failure()

    def fail(self, _kind: object, failure: BaseException, _trace: object) -> None:
        """Stops time because a function that C called has failed. The arguments are those of `__exit__`."""
        self._failure = failure
        self.model.failed = True

    def raise_failure(self) -> None:
        """Raises the exception passed to `fail`, once: exceptions cannot propagate through C."""
        if self._failure is not None:
            failure, self._failure = self._failure, None
            self.model.failed = False
            raise failure
