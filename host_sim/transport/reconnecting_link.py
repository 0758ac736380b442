"""A link that reconnects after a bus went down or an adapter was unplugged."""

import time
from collections.abc import Callable
from contextlib import suppress

from host_sim.base.errors import LinkDownError, OctetError, RobotError
from host_sim.transport.link import Frame, FrameSocket, LineStats, Link, SocketLink

_PAUSE_S = 0.1


class ReconnectingLink:
    """Opens a link again whenever it is gone. What is sent meanwhile is lost; `receive` waits until it is back."""

    def __init__(self, name: str, open_link: Callable[[], Link], stats: LineStats, patience_s: float) -> None:
        """Opens the link for the first time. If it is down, waits for it, as if it went down later.

        Args:
            name: Name of the line, for messages.
            open_link: Opens it.
            stats: Counts its outages and errors.
            patience_s: Time to wait for it when it is gone, s of wall-clock time.

        Raises:
            OctetError: It cannot be opened.
        """
        self._name, self._open_link, self._stats, self._patience_s = name, open_link, stats, patience_s
        self._link: Link | None = None
        self._gone_since: float | None = None
        try:
            self._link = open_link()
        except LinkDownError as error:
            self._note_gone(error)

    def send(self, frame: Frame) -> None:
        """As in `Link`, but if the line is gone, only the frame is lost."""
        if self._link is None:
            self._stats.unsent += 1
            return
        try:
            self._link.send(frame)
        except LinkDownError as error:
            self._stats.unsent += 1
            self._note_gone(error)
        else:
            self._gone_since = None

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`.

        If the line is gone, waits for it, whatever the timeout, and then returns None: only sending something shows
        whether the line works again.

        Raises:
            RobotError: The line has been gone for too long.
        """
        if self._gone_since is None and self._link is not None:
            try:
                return self._link.receive(timeout_s)
            except LinkDownError as error:
                self._note_gone(error)
        self._wait()
        return None

    def frame_socket(self) -> FrameSocket | None:
        """As in `SocketLink`."""
        there = self._link if self._gone_since is None else None
        return there.frame_socket() if isinstance(there, SocketLink) else None

    def close(self) -> None:
        """As in `Link`."""
        if self._link is not None:
            self._link.close()
            self._link = None

    def _note_gone(self, error: LinkDownError) -> None:
        if self._gone_since is None:
            self._gone_since = time.monotonic()
            self._stats.outages += 1
        self._stats.reason = str(error)
        with suppress(OSError, RobotError):
            self.close()
        self._link = None

    def _wait(self) -> None:
        """Waits until the line can be opened. Whether an open line works again shows with the next send."""
        assert self._gone_since is not None
        time.sleep(_PAUSE_S)
        while self._link is None:
            if time.monotonic() - self._gone_since > self._patience_s:
                raise RobotError(f"{self._name} has been gone for {self._patience_s:g} s: {self._stats.reason}")
            with suppress(OctetError):
                self._link = self._open_link()
                return
            time.sleep(_PAUSE_S)
