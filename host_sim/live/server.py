"""Serves a live run to browsers: the page and its parts over HTTP, the run itself over one WebSocket per page."""

import asyncio
import contextlib
import sys
from collections.abc import AsyncIterator, Awaitable, Callable

from aiohttp import WSCloseCode, web

from host_sim.base.paths import WEB
from host_sim.live.board_feed import BoardFeed, Class
from host_sim.live.connections import Connections, one_line_logger, report_to
from host_sim.live.feed import Memo, PageFeed
from host_sim.live.join_code import TooManyGuessesError
from host_sim.live.listener import Listener
from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import FULL_SPEED, TEXT_MAX
from host_sim.live.seats import Seats
from host_sim.live.visitor import Rights, Visitor
from host_sim.view.languages import languages, with_languages
from host_sim.view.templates import template

PAGES_MAX = 64
"""Maximum number of open pages: a class, those that have just been reloaded, and the board."""

FRAME_S, RACING_FRAME_S = 1 / 60, 1 / 20
"""Minimum time between two messages to a page; the second at full speed, which is too fast to follow anyway."""

STATE_S = 1 / 9000
"""Time for each robot's state in a message to a page; thirty pages with thirty robots get ten messages a second."""

_SAMPLE_S = 0.5

_HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}


_Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class LiveServer:
    """Serves one run to its pages, and to the board.

    Attributes:
        pages: Number of pages that watch.
        boards: Number of boards among them.
    """

    def __init__(self, live: PacedRun, listener: Listener) -> None:
        """Prepares the server; `serving` starts it.

        Args:
            live: The run.
            listener: The socket to serve on. If it is open to other machines, and there are several robots, each page
                gets a robot of its own.
        """
        self.pages = self.boards = 0
        self._live, self._listener, self._memo = live, listener, Memo()
        nodes = live.simulation.nodes
        self._seats = Seats(nodes) if listener.is_open and len(nodes) > 1 else None
        self._class = Class(live, listener, self._seats)
        self._sockets: set[web.WebSocketResponse] = set()
        self._parts = {path.relative_to(WEB).as_posix() for path in WEB.rglob("*") if path.suffix in (".js", ".css")}
        self._app = web.Application(client_max_size=TEXT_MAX, middlewares=[self._check_host])
        self._app.on_response_prepare.append(_secure)
        for path, handler in (
            ("/", self._page),
            ("/board", self._board),
            ("/live", self._page_socket),
            ("/board-live", self._board_socket),
            ("/{code:[A-Za-z]+-?[0-9]{4}}", self._join),
            ("/{name:.+}", self._part),
        ):
            self._app.router.add_get(path, handler)

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
        sampler = asyncio.create_task(self._sample())
        try:
            yield
        finally:
            sampler.cancel()
            for page in list(self._sockets):
                await _say_goodbye(page)
            server.close()
            await runner.cleanup()
            for handler in logger.handlers:
                handler.close()

    async def _sample(self) -> None:
        """Samples the curves, even without an open board, so that one opened later shows all of them."""
        while True:
            self._class.curves.sample()
            await asyncio.sleep(_SAMPLE_S)

    @web.middleware
    async def _check_host(self, request: web.Request, handler: _Handler) -> web.StreamResponse:
        if not self._listener.is_ours(request.host):
            self._live.refused += 1
            raise web.HTTPForbidden(text=_told("the address must be the one that octet printed"))
        return await handler(request)

    async def _page(self, request: web.Request) -> web.StreamResponse:
        self._check_token(request, self._listener.holds)
        return _html("live.html")

    async def _board(self, request: web.Request) -> web.StreamResponse:
        self._check_token(request, self._listener.holds_board)
        return _html("board.html")

    async def _join(self, request: web.Request) -> web.StreamResponse:
        """Redirects a visitor with the correct code to the page."""
        if self._listener.code is None:
            raise web.HTTPNotFound
        try:
            if self._listener.code.opens(request.match_info["code"], request.remote or ""):
                raise web.HTTPFound(f"/?token={self._listener.token}")
        except TooManyGuessesError as error:
            raise web.HTTPTooManyRequests(text=_told(f"{error}")) from None
        self._live.refused += 1
        raise web.HTTPForbidden(text=_told("that is not the code: compare it with the one on the board"))

    async def _part(self, request: web.Request) -> web.StreamResponse:
        name = request.match_info["name"]
        if name not in self._parts:
            raise web.HTTPNotFound
        return _file(name)

    async def _page_socket(self, request: web.Request) -> web.StreamResponse:
        self._check_token(request, self._listener.holds)
        socket = await self._accepted(request)
        seats = None if self._listener.holds_board(request.query["token"]) else self._seats
        with Rights.of(seats, request.query.get("page", "")) as rights:
            self.pages += 1
            self._live.change += 1
            self._begin_unless_the_board_does()
            feed = PageFeed(self._live, self._memo, rights)
            try:
                await self._serve(Visitor(socket, feed, rights, self._pause_s, ask=feed.ask))
            finally:
                self.pages -= 1
        return socket

    async def _board_socket(self, request: web.Request) -> web.StreamResponse:
        self._check_token(request, self._listener.holds_board)
        socket = await self._accepted(request)
        self.pages += 1
        self.boards += 1
        feed = BoardFeed(self._live, self._memo, of=self._class)
        try:
            await self._serve(Visitor(socket, feed, feed.rights, self._pause_s, begins=True))
        finally:
            self.pages -= 1
            self.boards -= 1
            self._begin_unless_the_board_does()
        return socket

    def _begin_unless_the_board_does(self) -> None:
        """Begins the run for the first page, unless a board is open, whose button begins it."""
        if self.pages and not self.boards:
            self._live.seen()

    def _pause_s(self) -> float:
        """Time between two messages to a page, s; it grows with the amount of data for all pages."""
        fastest = RACING_FRAME_S if self._live.speed == FULL_SPEED else FRAME_S
        return max(fastest, self.pages * len(self._live.simulation.nodes) * STATE_S)

    async def _accepted(self, request: web.Request) -> web.WebSocketResponse:
        """Accepts the connection of a page, which is not counted yet.

        Raises:
            web.HTTPException: The page is not ours, or there are too many.
        """
        self._check_origin(request)
        if self.pages >= PAGES_MAX:
            raise web.HTTPServiceUnavailable(text=f"{PAGES_MAX} pages are watching already\n")
        page = web.WebSocketResponse(max_msg_size=TEXT_MAX, heartbeat=20.0, compress=False, timeout=1.0)
        await page.prepare(request)
        self._connections.keep(request)
        return page

    async def _serve(self, visitor: Visitor) -> None:
        self._sockets.add(visitor.socket)
        try:
            await visitor.serve(self._live)
        finally:
            self._sockets.discard(visitor.socket)

    def _check_token(self, request: web.Request, holds: Callable[[str], bool]) -> None:
        if not holds(request.query.get("token", "")):
            self._live.refused += 1
            raise web.HTTPForbidden(text=_told("the address must end with ?token=..., as octet printed it"))

    def _check_origin(self, request: web.Request) -> None:
        """Allows only our own page to open a socket: any other page in the same browser could try."""
        if request.headers.get("Origin") != f"http://{request.host}":
            self._live.refused += 1
            raise web.HTTPForbidden(text="only octet's own page may connect\n")


async def _say_goodbye(page: web.WebSocketResponse) -> None:
    with contextlib.suppress(ConnectionError, asyncio.TimeoutError):
        await asyncio.wait_for(page.close(code=WSCloseCode.GOING_AWAY, message=b"the run has ended"), 1.0)


def _told(what: str) -> str:
    """A refusal in all languages, since no page has determined the reader's yet."""
    return "".join(f"{words.get('refused', {}).get(what, what)}\n" for words in languages().values())


def _html(name: str) -> web.Response:
    return web.Response(text=with_languages(template(name)), content_type="text/html")


def _file(name: str) -> web.FileResponse:
    return web.FileResponse(WEB / name)


async def _secure(_request: web.Request, response: web.StreamResponse) -> None:
    response.headers.update(_HEADERS)
