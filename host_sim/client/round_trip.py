"""The retransmission timeout, estimated from the round-trip times so far."""

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
