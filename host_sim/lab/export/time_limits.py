"""The latest times that the formats of other programs have room for."""

from collections.abc import Iterable, Iterator

from host_sim.base.errors import OctetError
from host_sim.recording.log_text import Recorded

_YEAR_9999_S = 253_370_764_800
_NANOSECONDS_S = 2**64 // 10**9 - 1

LAST_S = {"asc": _YEAR_9999_S, "blf": _YEAR_9999_S, "mf4": _NANOSECONDS_S, "mcap": _NANOSECONDS_S}
"""By format, in s since 1970: dates have years of four digits, or nanoseconds have 64 bits."""


def within_limits(frames: Iterable[Recorded], name: str) -> Iterator[Recorded]:
    """The frames, in order.

    Args:
        frames: The frames.
        name: The format.

    Raises:
        OctetError: A frame is later than the format can say.
    """
    last_s = LAST_S.get(name)
    for recorded in frames:
        if last_s is not None and recorded.time_us > last_s * 1_000_000:
            raise OctetError(
                f"a frame at {recorded.time_us / 1e6:.0f} s is too late for {name.upper()}, which ends at {last_s} s:"
                " is that log in seconds?"
            )
        yield recorded
