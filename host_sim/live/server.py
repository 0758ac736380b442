"""Serves a live run to browsers: the page and its parts over HTTP, the run itself over one WebSocket per page."""

import asyncio
import contextlib
import time
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass, field
from types import MappingProxyType

from aiohttp import WSCloseCode, WSMsgType, web

from host_sim.live.feed import Memo, PageFeed
from host_sim.live.listener import Listener
from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import FULL_SPEED, TEXT_MAX, Question, page_command_from
from host_sim.live.page_server import HEADERS, PageServer

_PAGE = "page"

_POLICY = HEADERS["Content-Security-Policy"].replace(
    "script-src 'self'", "script-src 'self' 'wasm-unsafe-eval'; worker-src blob:"
)
"""Lets the page simulate other futures: in a worker that it makes, with the firmware as WebAssembly."""

PAGES_MAX = 64
"""Maximum number of open pages, those that have just been reloaded among them."""

IDLE_S = 60.0
"""If no more pages fit, the one that has been idle for longest is closed, if that is at least this time, s."""

FRAME_S, RACING_FRAME_S = 1 / 60, 1 / 20
"""Minimum time between two messages to a page; the second at full speed, which is too fast to follow anyway."""

_LOOK_S = 0.01
_REFUSALS_MAX = 100

STATE_S = 1 / 9000
"""Time for each robot's state in a message to a page; thirty pages with thirty robots get ten messages a second."""

HAND_OVER_S = 5.0
"""Maximum time that pages have to fetch the recording of a run that has ended, s."""


@dataclass
class Visitor:
    """One page.

    Attributes:
        socket: Its connection.
        feed: The messages to it.
        pause_s: Returns the minimum time between two messages to it, s.
        heard_s: When it was opened, or last sent a message, on the monotonic clock.
    """

    socket: web.WebSocketResponse
    feed: PageFeed
    pause_s: Callable[[], float]
    heard_s: float = field(default_factory=time.monotonic)

    async def serve(self, live: PacedRun) -> None:
        """Serves it until it disconnects, or has sent too many invalid messages."""
        sender = asyncio.create_task(self._send())
        try:
            await self._receive(live)
        finally:
            sender.cancel()

    async def _send(self) -> None:
        """Sends the latest state, as fast as the page reads."""
        with contextlib.suppress(ConnectionError):
            while not self.socket.closed:
                message = self.feed.next()
                if message is not None:
                    await self.socket.send_str(message)
                await asyncio.sleep(self.pause_s())

    async def _receive(self, live: PacedRun) -> None:
        refusals = 0
        while refusals < _REFUSALS_MAX:
            message = await self.socket.receive()
            self.heard_s = time.monotonic()
            if message.type is WSMsgType.TEXT:
                refusals += not self._accept(message.data, live)
            elif message.type is WSMsgType.BINARY:
                live.refused += 1
                refusals += 1
            else:
                live.refused += message.type is WSMsgType.ERROR
                return
        await self.socket.close(code=WSCloseCode.POLICY_VIOLATION, message=b"too many invalid messages")

    def _accept(self, text: str, live: PacedRun) -> bool:
        """Carries out a message; False if it is not a command."""
        try:
            self._obey(text, live)
        except ValueError as error:
            live.refused += 1
            live.change += 1
            self.feed.notes.append(f"not understood: {error}"[:200])
            return False
        return True

    def _obey(self, text: str, live: PacedRun) -> None:
        command = page_command_from(text)
        if isinstance(command, Question):
            self.feed.ask(command)
            live.change += 1
        else:
            live.offer(command, self.feed.notes.append)


class LiveServer(PageServer):
    """Serves one run to its pages, and its recording so far.

    Attributes:
        pages: Number of pages that watch.
    """

    policies = MappingProxyType({"/": _POLICY})

    def __init__(
        self,
        live: PacedRun,
        listener: Listener,
        page: str,
        recorded: Callable[[], str | None] = lambda: None,
    ) -> None:
        """Prepares the server; `serving` starts it.

        Args:
            live: The run.
            listener: The socket to serve on.
            page: The HTML of its page.
            recorded: Returns the run so far as the page fetches it; None before the first tick.
        """
        super().__init__(listener, TEXT_MAX)
        self.pages = 0
        self._live, self._memo, self._page_text, self._recorded = live, Memo(), page, recorded
        self._kept: tuple[tuple[int, int], str | None] = ((-1, -1), None)
        self._read = 0
        self._visitors: dict[web.WebSocketResponse, Visitor] = {}
        self.add_routes(
            web.get("/", self._page),
            web.get("/live", self._page_socket),
            web.get("/recorded", self._recording),
        )

    @contextlib.asynccontextmanager
    async def serving(self) -> AsyncIterator[None]:
        """Serves until the context is left."""
        async with self.listening():
            try:
                yield
            finally:
                await self._hand_over()

    def on_refusal(self) -> None:
        """Counts a refused request."""
        self._live.refused += 1

    async def _page(self, request: web.Request) -> web.StreamResponse:
        return self.page(request, self._page_text, self.listener.holds, _PAGE)

    async def _hand_over(self) -> None:
        """Tells all pages that the run has ended, and waits until each has fetched the recording."""
        pages, began = list(self._visitors), time.monotonic()
        due = self._read + len(pages) if pages and self._so_far() else 0
        for page in pages:
            await _say_goodbye(page, WSCloseCode.GOING_AWAY, b"the run has ended")
        while self._read < due and time.monotonic() - began < HAND_OVER_S:
            await asyncio.sleep(_LOOK_S)

    async def _recording(self, request: web.Request) -> web.StreamResponse:
        self.admitted(request, self.listener.holds, _PAGE)
        text = self._so_far()
        if text is None:
            raise web.HTTPNotFound
        self._read += 1
        return web.Response(text=text, content_type="application/json")

    def _so_far(self) -> str | None:
        """The run so far, made once for all pages that ask at the same time."""
        now = (self._live.simulation.tick, self._live.change)
        if self._kept[0] != now:
            self._kept = (now, self._recorded())
        return self._kept[1]

    async def _page_socket(self, request: web.Request) -> web.StreamResponse:
        self.admitted(request, self.listener.holds, _PAGE)
        socket = await self._accepted(request)
        self.pages += 1
        self._live.change += 1
        self._live.seen()
        feed = PageFeed(self._live, self._memo)
        try:
            await self._serve(Visitor(socket, feed, self._pause_s))
        finally:
            self.pages -= 1
        return socket

    def _pause_s(self) -> float:
        """Time between two messages to a page, s; it grows with the amount of data for all pages."""
        fastest = RACING_FRAME_S if self._live.speed == FULL_SPEED else FRAME_S
        return max(fastest, self.pages * len(self._live.simulation.nodes) * STATE_S)

    async def _accepted(self, request: web.Request) -> web.WebSocketResponse:
        """Accepts the connection of a page, which is not counted yet.

        Raises:
            web.HTTPException: The page is not ours, or there are too many.
        """
        self.check_origin(request)
        if self.pages >= PAGES_MAX:
            await self._make_room()
        page = web.WebSocketResponse(max_msg_size=TEXT_MAX, heartbeat=20.0, compress=False, timeout=1.0)
        await page.prepare(request)
        self._connections.keep(request)
        return page

    async def _make_room(self) -> None:
        """Closes the page that has been idle for longest.

        Raises:
            web.HTTPException: None has been idle for long enough.
        """
        oldest = min(self._visitors.values(), key=lambda visitor: visitor.heard_s, default=None)
        if oldest is None or time.monotonic() - oldest.heard_s < IDLE_S:
            raise web.HTTPServiceUnavailable(text=f"{PAGES_MAX} pages are watching already\n")
        await _say_goodbye(oldest.socket, WSCloseCode.TRY_AGAIN_LATER, b"another page needs the place")

    async def _serve(self, visitor: Visitor) -> None:
        self._visitors[visitor.socket] = visitor
        try:
            await visitor.serve(self._live)
        finally:
            del self._visitors[visitor.socket]


async def _say_goodbye(page: web.WebSocketResponse, code: WSCloseCode, why: bytes) -> None:
    with contextlib.suppress(ConnectionError, asyncio.TimeoutError):
        await asyncio.wait_for(page.close(code=code, message=why), 1.0)
