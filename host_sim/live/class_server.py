"""Serves a class: to each pupil the page with a robot of its own, to the teacher the board with everybody's goals."""

import asyncio
import contextlib
import json
import logging
import time
from collections.abc import AsyncIterator
from dataclasses import asdict
from types import MappingProxyType
from typing import Any

from aiohttp import web

from host_sim.base.errors import OctetError
from host_sim.live.class_roster import Roster, RosterError
from host_sim.live.listener import Listener
from host_sim.live.page_server import PageServer, page_text

_BODY_MAX = 16_384
"""Maximum size of a report, bytes."""

_SAVE_S = 1.0
_PAGE, _BOARD = "page", "board"


class ClassServer(PageServer):
    """Serves the page and the board, and keeps what pages report."""

    policies = MappingProxyType({"/": "frame-ancestors 'none'"})

    def __init__(self, roster: Roster, listener: Listener, page: str) -> None:
        """Prepares the server; `serving` starts it.

        Args:
            roster: The class.
            listener: The socket to serve on.
            page: The page of each pupil.
        """
        super().__init__(listener, _BODY_MAX)
        self._roster = roster
        self._page_text = page
        self.add_routes(
            web.get("/", self._page),
            web.post("/report", self._report),
            web.get("/board", self._board),
            web.get("/pupils", self._pupils),
            web.get("/class.csv", self._csv),
            web.post("/code", self._take_code),
            web.post("/remove", self._remove),
        )

    @contextlib.asynccontextmanager
    async def serving(self) -> AsyncIterator[None]:
        """Serves until the context is left; then saves the class."""
        async with self.listening() as logger:
            saver = asyncio.create_task(self._save(logger))
            try:
                yield
            finally:
                saver.cancel()
                self._roster.save()

    async def _save(self, logger: logging.Logger) -> None:
        while True:
            await asyncio.sleep(_SAVE_S)
            if self._roster.changed:
                try:
                    self._roster.save()
                except OctetError as error:
                    logger.error("%s", error)

    async def _page(self, request: web.Request) -> web.StreamResponse:
        return self.page(request, self._page_text, self.listener.holds, _PAGE, _BOARD)  # the board shows pupils' runs

    async def _board(self, request: web.Request) -> web.StreamResponse:
        return self.page(request, page_text("board.html"), self.listener.holds_board, _BOARD)

    async def _report(self, request: web.Request) -> web.StreamResponse:
        self.admitted(request, self.listener.holds, _PAGE, _BOARD)
        try:
            self._roster.report(await _object_in(request))
        except RosterError as error:
            raise web.HTTPBadRequest(text=f"{error}") from None
        return web.Response(status=204)

    async def _pupils(self, request: web.Request) -> web.StreamResponse:
        self.admitted(request, self.listener.holds_board, _BOARD)
        now_s = time.time()
        pupils = [
            {**asdict(pupil), "key": key, "silent_s": now_s - pupil.heard_s if pupil.heard_s else None}
            for key, pupil in self._roster.pupils.items()
        ]
        join = {"urls": self.listener.short_urls, "modules": self.listener.qr_modules}
        return web.json_response({"pupils": pupils, "join": join})

    async def _csv(self, request: web.Request) -> web.StreamResponse:
        self.admitted(request, self.listener.holds_board, _BOARD)
        kept = {"Content-Disposition": 'attachment; filename="class.csv"'}
        return web.Response(text=self._roster.table(), content_type="text/csv", headers=kept)

    async def _take_code(self, request: web.Request) -> web.StreamResponse:
        self.admitted(request, self.listener.holds_board, _BOARD)
        try:
            said = await _object_in(request)
            self._roster.take_code(f"{said.get('name', '')}", f"{said.get('code', '')}")
        except RosterError as error:
            return web.json_response({"done": False, "why": f"{error}"})
        return web.json_response({"done": True})

    async def _remove(self, request: web.Request) -> web.StreamResponse:
        self.admitted(request, self.listener.holds_board, _BOARD)
        with contextlib.suppress(RosterError):
            self._roster.remove(f"{(await _object_in(request)).get('key', '')}")
        return web.json_response({"done": True})


async def _object_in(request: web.Request) -> dict[str, Any]:
    """The JSON object that a request carries.

    Raises:
        RosterError: It carries none.
    """
    try:
        said = json.loads(await request.text())
    except (ValueError, RecursionError):
        said = None
    if not isinstance(said, dict):
        raise RosterError("the body must be a JSON object")
    return said
