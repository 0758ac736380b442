"""Limits and one-line error reports for the page server's connections."""

import asyncio
import logging
from collections.abc import Callable, Mapping
from typing import Any, TextIO

from aiohttp import web

from host_sim.base.system import files_max

CONNECTIONS_MAX = 512
"""Maximum number of open connections; a new one then takes the place of the oldest that is not a WebSocket."""

LIFETIME_S = 15.0
"""Maximum lifetime of a connection that is not a WebSocket, s: browsers open another one."""

_PROTOCOL_ERROR = b"\x88\x02\x03\xea"
"""The frame that closes a WebSocket with code 1002."""

_LENGTH_AT, _MASKED, _MASK_BYTES, _LONGER_BYTES = 1, 0x80, 4, {126: 2, 127: 8}
_KEEP_ALIVE_S = 5.0
_LINES_MAX = 20
_TEXT_MAX = 200


class Connections:
    """Makes the protocols of a server's connections.

    Attributes:
        most: Maximum number of open connections.
    """

    def __init__(self, server: web.Server, headers: Mapping[str, str], logger: logging.Logger) -> None:
        """Creates the factory, which must be called in a running event loop.

        Args:
            server: Handles the requests.
            headers: Headers of the answers to requests that are not HTTP.
            logger: Receives the errors.
        """
        self.most = min(CONNECTIONS_MAX, files_max() // 2)
        self._server, self._headers, self._logger = server, headers, logger
        self._closable: dict[_Connection, None] = {}

    def __call__(self) -> asyncio.Protocol:
        """The protocol of a new connection."""
        return _Connection(self, self._server, self._logger)

    def keep(self, request: web.Request) -> None:
        """Exempts a request's connection, which has become a WebSocket, from limits."""
        connection = request.protocol
        assert isinstance(connection, _Connection)
        connection.deadline.cancel()
        connection.masks = _Masks()
        self._closable.pop(connection, None)

    def opened(self, connection: "_Connection") -> None:
        """Counts a connection; closes the oldest one if there are too many."""
        self._closable[connection] = None
        if len(self._closable) > self.most:
            next(iter(self._closable)).abort()

    def closed(self, connection: "_Connection") -> None:
        """Forgets a connection."""
        self._closable.pop(connection, None)

    def secure(self, response: web.StreamResponse) -> None:
        """Adds the security headers to an answer."""
        response.headers.update(self._headers)


class _Connection(web.RequestHandler):
    """One connection, which ends at its deadline."""

    deadline: asyncio.TimerHandle
    masks: "_Masks | None" = None

    def __init__(self, all_of_them: Connections, server: web.Server, logger: logging.Logger) -> None:
        loop = asyncio.get_running_loop()
        super().__init__(server, loop=loop, keepalive_timeout=_KEEP_ALIVE_S, logger=logger)
        self._connections = all_of_them

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        super().connection_made(transport)
        self.deadline = asyncio.get_running_loop().call_later(LIFETIME_S, self.abort)
        self._connections.opened(self)

    def connection_lost(self, exc: BaseException | None) -> None:
        self.deadline.cancel()
        self._connections.closed(self)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        if self.masks is None or self.masks.are_in(data):
            super().data_received(data)
        elif isinstance(self.transport, asyncio.Transport):
            self.transport.write(_PROTOCOL_ERROR)
            self.transport.close()

    def abort(self) -> None:
        """Closes the connection at once, whatever is still to be sent."""
        self._connections.closed(self)
        if self.transport is not None:
            self.transport.abort()

    def handle_error(self, *args: Any, **kwargs: Any) -> web.StreamResponse:
        response = super().handle_error(*args, **kwargs)
        self._connections.secure(response)
        return response


class _Masks:
    """Follows the frames of a WebSocket. Clients must mask theirs (RFC 6455, 5.1); aiohttp accepts others, too."""

    def __init__(self) -> None:
        self._head, self._left = bytearray(), 0

    def are_in(self, data: bytes) -> bool:
        """Whether each frame that begins in the next bytes of the connection is masked."""
        at = 0
        while at < len(data):
            if self._left:
                passed = min(self._left, len(data) - at)
                self._left -= passed
                at += passed
                continue
            self._head.append(data[at])
            at += 1
            if len(self._head) == _LENGTH_AT + 1 and not self._head[_LENGTH_AT] & _MASKED:
                return False
            self._end_head()
        return True

    def _end_head(self) -> None:
        """Continues with the payload if the header is complete."""
        if len(self._head) <= _LENGTH_AT:
            return
        length = self._head[_LENGTH_AT] & ~_MASKED
        more = _LONGER_BYTES.get(length, 0)
        if len(self._head) == _LENGTH_AT + 1 + more + _MASK_BYTES:
            self._left = int.from_bytes(self._head[_LENGTH_AT + 1 :][:more], "big") if more else length
            self._head.clear()


class _Lines(logging.Handler):
    """Prints each record as one line without a traceback; only counts records after a number of lines."""

    def __init__(self, out: TextIO) -> None:
        super().__init__(logging.WARNING)
        self._out, self._count = out, 0

    def emit(self, record: logging.LogRecord) -> None:
        self._count += 1
        if self._count <= _LINES_MAX:
            cause = record.exc_info[1] if record.exc_info else None
            self._print(record.getMessage() + (f": {cause!r}" if cause else ""))

    def close(self) -> None:
        if self._count > _LINES_MAX:
            self._print(f"{self._count - _LINES_MAX} further errors")
        super().close()

    def _print(self, text: str) -> None:
        line = ascii(text)[1:-1]
        print(f"octet: page server: {line[:_TEXT_MAX]}", file=self._out, flush=True)


def one_line_logger(out: TextIO) -> logging.Logger:
    """A logger that prints at most a screenful of lines, and no traceback."""
    logger = logging.Logger("octet.page_server")
    logger.addHandler(_Lines(out))
    return logger


def report_to(logger: logging.Logger) -> Callable[[asyncio.AbstractEventLoop, dict[str, Any]], None]:
    """An event loop's exception handler that reports to a logger."""

    def report(_loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        logger.error(context["message"], exc_info=context.get("exception"))

    return report
