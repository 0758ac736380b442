"""Joins the two frames that report the learned memory."""

from collections.abc import Callable
from operator import itemgetter

from host_sim.protocol.codec import DecodedFrame
from host_sim.protocol.generated import CELL_COUNT

_HALVES = 2
_CELLS: Callable[[dict[str, int]], tuple[int, ...]] = itemgetter(*(f"cell_{cell}" for cell in range(CELL_COUNT)))


class MemoryReport:
    """Joins the two halves of a memory, in either order."""

    def __init__(self) -> None:
        """Starts without any half."""
        self._halves: dict[int, DecodedFrame] = {}

    def join(self, decoded: DecodedFrame) -> tuple[int, ...] | None:
        """The eight cells when both halves have come; None after the first, or if one of them was lost.

        Args:
            decoded: A MEMORY.
        """
        half, counter = decoded.signals["half"], decoded.signals["counter"]
        if half not in range(_HALVES):
            return None
        other = self._halves.get(1 - half)
        self._halves = {half: decoded}
        if other is None or other.signals["counter"] != counter:
            return None
        self._halves = {}
        return _CELLS(other.signals | decoded.signals)
