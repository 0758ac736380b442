"""The learned memory, which comes in two frames."""

from host_sim.protocol.codec import DecodedFrame
from host_sim.protocol.generated import CELL_COUNT


class MemoryReport:
    """Joins the two halves of a memory."""

    def __init__(self) -> None:
        """Has not seen any half yet."""
        self._lower: DecodedFrame | None = None

    def join(self, decoded: DecodedFrame) -> tuple[int, ...] | None:
        """The eight cells when their second half has come; None after the first, or if one of them was lost.

        Args:
            decoded: A MEMORY.
        """
        lower, self._lower = self._lower, None
        if decoded.signals["half"] == 0:
            self._lower = decoded
            return None
        if lower is None or lower.signals["counter"] != decoded.signals["counter"]:
            return None
        both = lower.signals | decoded.signals
        cells = tuple(both.get(f"cell_{cell}", -1) for cell in range(CELL_COUNT))
        return cells if min(cells) >= 0 else None
