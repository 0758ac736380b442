"""Serves a live run to browsers: the page and its parts over HTTP, the run itself over one WebSocket per page."""

import asyncio
import contextlib
import ipaddress
import os
import secrets
import socket
import sys
from collections.abc import AsyncIterator, Awaitable, Callable

from aiohttp import WSCloseCode, WSMsgType, web
from yarl import URL

from host_sim.errors import UsageError
from host_sim.live.connections import Connections, one_line_logger, report_to
from host_sim.live.feed import PageFeed
from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import FULL_SPEED, TEXT_MAX, page_command_from
from host_sim.live.token_file import local_token
from host_sim.paths import WEB

PAGES_MAX = 32
FRAME_S, RACING_FRAME_S = 1 / 60, 1 / 30
"""Minimum time between two messages to a page; the second at full speed, which is too fast to follow anyway."""

_REFUSALS_MAX = 100
_ANYWHERE = ("0.0.0.0", "::")
_HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}


_Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class Listener:
    """The listening socket of the server, opened before the run begins: a port in use must not spoil a run.

    Attributes:
        host: Address that it listens on.
        port: Port that it listens on.
        token: Secret that a page's address must contain: other users of this machine can connect, too.
        socket: The socket.
    """

    def __init__(self, listen: str | None, port: int) -> None:
        """Opens the socket.

        Args:
            listen: Address to listen on for other machines; None for this machine only.
            port: Port to listen on; 0 for any free port.

        Raises:
            UsageError: The address does not exist or is in use.
        """
        self.host = listen or "127.0.0.1"
        self.token = secrets.token_urlsafe(16) if listen else local_token()
        try:
            family, *_, address = socket.getaddrinfo(self.host, port, type=socket.SOCK_STREAM)[0]
            self.socket = socket.create_server((address[0], port), family=family)
        except OSError as error:
            unknown = isinstance(error, socket.gaierror)
            why = "no such address" if unknown or error.errno is None else os.strerror(error.errno).lower()
            where = f"{self.host}, port {port}"
            raise UsageError(f"cannot listen on {where}: {why}; choose another with --port or --listen") from None
        self.port: int = self.socket.getsockname()[1]

    @property
    def url(self) -> str:
        """The page's address."""
        host = f"[{self.host}]" if self.socket.family is socket.AF_INET6 else self.host
        if self.host in _ANYWHERE:
            host = socket.gethostname()
        return f"http://{host}:{self.port}/?token={self.token}"

    def is_ours(self, host: str) -> bool:
        """Whether a request's Host header is an address, or a name of this machine that the user knows.

        A page of another site can have its own name resolve to this machine (DNS rebinding); its requests then come
        with that name.
        """
        name = _host_name(host)
        return name in ("localhost", self.host.lower(), socket.gethostname().lower()) or _is_address(name)


def _host_name(host: str) -> str | None:
    """The name in a Host header, without the port; None if it is not a host."""
    try:
        return URL(f"http://{host}").host
    except ValueError:
        return None


def _is_address(name: str | None) -> bool:
    try:
        ipaddress.ip_address(name or "")
    except ValueError:
        return False
    return True


class LiveServer:
    """Serves one run to its pages.

    Attributes:
        pages: Number of pages that watch.
    """

    def __init__(self, live: PacedRun, listener: Listener) -> None:
        """Prepares the server; `serving` starts it.

        Args:
            live: The run.
            listener: The socket to serve on.
        """
        self.pages = 0
        self._live, self._listener = live, listener
        self._sockets: set[web.WebSocketResponse] = set()
        self._app = web.Application(client_max_size=TEXT_MAX, middlewares=[self._check_host])
        self._app.on_response_prepare.append(_secure)
        self._app.router.add_get("/", self._page)
        self._app.router.add_get("/live", self._socket)
        self._app.router.add_get("/{name}", self._part)

    @contextlib.asynccontextmanager
    async def serving(self) -> AsyncIterator[None]:
        """Serves until the context is left."""
        logger, loop = one_line_logger(sys.stderr), asyncio.get_running_loop()
        loop.set_exception_handler(report_to(logger))
        runner = web.AppRunner(self._app, access_log=None, shutdown_timeout=1.0)
        await runner.setup()
        assert runner.server is not None
        self._connections = Connections(runner.server, _HEADERS, logger)
        server = await loop.create_server(self._connections, sock=self._listener.socket)
        try:
            yield
        finally:
            for page in list(self._sockets):
                await _say_goodbye(page)
            server.close()
            await runner.cleanup()
            for handler in logger.handlers:
                handler.close()

    @web.middleware
    async def _check_host(self, request: web.Request, handler: _Handler) -> web.StreamResponse:
        if not self._listener.is_ours(request.host):
            self._live.refused += 1
            raise web.HTTPForbidden(text="the address must be the one that octet printed\n")
        return await handler(request)

    async def _page(self, request: web.Request) -> web.StreamResponse:
        self._check_token(request)
        return _file("live.html")

    async def _part(self, request: web.Request) -> web.StreamResponse:
        name = request.match_info["name"]
        if name not in _parts():
            raise web.HTTPNotFound
        return _file(name)

    async def _socket(self, request: web.Request) -> web.StreamResponse:
        self._check_token(request)
        self._check_origin(request)
        if self.pages >= PAGES_MAX:
            raise web.HTTPServiceUnavailable(text=f"{PAGES_MAX} pages are watching already\n")
        page = web.WebSocketResponse(max_msg_size=TEXT_MAX, heartbeat=20.0, compress=False, timeout=1.0)
        self._connections.keep(request)
        await page.prepare(request)
        self._sockets.add(page)
        self.pages += 1
        self._live.seen()
        feed = PageFeed(self._live)
        sender = asyncio.create_task(_send(page, feed))
        try:
            await self._receive(page, feed)
        finally:
            sender.cancel()
            self.pages -= 1
            self._sockets.discard(page)
        return page

    async def _receive(self, page: web.WebSocketResponse, feed: PageFeed) -> None:
        """Accepts commands until the page disconnects, or has sent too many invalid messages."""
        refusals = 0
        while refusals < _REFUSALS_MAX:
            message = await page.receive()
            if message.type is WSMsgType.TEXT:
                refusals += not self._accept(message.data, feed)
            elif message.type is WSMsgType.BINARY:
                self._live.refused += 1
                refusals += 1
            else:
                self._live.refused += message.type is WSMsgType.ERROR
                return
        await page.close(code=WSCloseCode.POLICY_VIOLATION, message=b"too many invalid messages")

    def _accept(self, text: str, feed: PageFeed) -> bool:
        try:
            command = page_command_from(text)
        except ValueError as error:
            self._live.refused += 1
            self._live.change += 1
            feed.notes.append(f"not understood: {error}"[:200])
            return False
        self._live.offer(command, feed.notes.append)
        return True

    def _check_token(self, request: web.Request) -> None:
        given = request.query.get("token", "")
        if not secrets.compare_digest(given.encode(), self._listener.token.encode()):
            self._live.refused += 1
            raise web.HTTPForbidden(text="the address must end with ?token=..., as octet printed it\n")

    def _check_origin(self, request: web.Request) -> None:
        """Allows only our own page to open a socket: any other page in the same browser could try."""
        if request.headers.get("Origin") != f"http://{request.host}":
            self._live.refused += 1
            raise web.HTTPForbidden(text="only octet's own page may connect\n")


async def _send(page: web.WebSocketResponse, feed: PageFeed) -> None:
    """Sends a page the latest state, as fast as it reads."""
    with contextlib.suppress(ConnectionError):
        while not page.closed:
            message = feed.next()
            if message is not None:
                await page.send_str(message)
            await asyncio.sleep(RACING_FRAME_S if feed.live.speed == FULL_SPEED else FRAME_S)


async def _say_goodbye(page: web.WebSocketResponse) -> None:
    with contextlib.suppress(ConnectionError, asyncio.TimeoutError):
        await asyncio.wait_for(page.close(code=WSCloseCode.GOING_AWAY, message=b"the run has ended"), 1.0)


def _parts() -> set[str]:
    return {path.name for path in WEB.iterdir() if path.suffix in (".js", ".css")}


def _file(name: str) -> web.FileResponse:
    return web.FileResponse(WEB / name)


async def _secure(_request: web.Request, response: web.StreamResponse) -> None:
    response.headers.update(_HEADERS)
