"""One line shared by several robots, for buses that can be opened only once, such as a serial adapter."""

import time
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from host_sim.transport.link import Frame, Link

_WAITING_MAX = 4096
_OVERTIME_MAX = 256
"""Maximum number of frames taken after the timeout: those already waiting, but not an endless flood."""


class SharedLine:
    """Distributes the frames of a line to the links of the robots."""

    def __init__(self, line: Link, ids: Mapping[int, Sequence[int]]) -> None:
        """Shares a line, which remains the caller's to close.

        Args:
            line: The line.
            ids: The identifiers for each robot's link, by node.
        """
        self._line = line
        self._waiting: dict[int, deque[Frame]] = {node: deque(maxlen=_WAITING_MAX) for node in ids}
        self._owners = {frame_id: self._waiting[node] for node, its_ids in ids.items() for frame_id in its_ids}

    def share(self, node: int) -> Link:
        """A link that receives frames for one robot from now on, and the noise that arrives while it listens.

        Frames for it that arrive while others listen are kept; of too many, the oldest are lost.
        """
        self._waiting[node].clear()
        return _Share(self._line, self._owners, self._waiting[node])


@dataclass
class _Share:
    """One robot's part of a line."""

    line: Link
    owners: Mapping[int, deque[Frame]]
    mine: deque[Frame]

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        self.line.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`."""
        if self.mine:
            return self.mine.popleft()
        give_up, left_s, overtime = time.monotonic() + timeout_s, timeout_s, 0
        while overtime < _OVERTIME_MAX and (frame := self.line.receive(left_s)) is not None:
            owner = self.owners.get(frame.id, self.mine)
            if owner is self.mine:
                return frame
            owner.append(frame)
            left_s = max(give_up - time.monotonic(), 0.0)
            overtime += not left_s
        return None

    def close(self) -> None:
        """As in `Link`; the line stays open for the others."""
