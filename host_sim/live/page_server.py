"""What each server of pages does: its socket, the secrets, the short code, the headers, and the parts of pages."""

import asyncio
import contextlib
import logging
import sys
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping

from aiohttp import web

from host_sim.base.paths import PAGE_SCRIPTS, WEB
from host_sim.live.connections import Connections, one_line_logger, report_to
from host_sim.live.join_code import TooManyGuessesError
from host_sim.live.listener import Listener
from host_sim.talk.languages import languages, template, with_languages

HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}

Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class PageServer:
    """Serves pages to those who have their secrets, and the pages' scripts and style sheets to everyone.

    Attributes:
        listener: The socket that it serves on.
        policies: The content security policies of pages that have another one, by their paths.
    """

    policies: Mapping[str, str] = {}

    def __init__(self, listener: Listener, body_max: int) -> None:
        """Prepares the server; a class that extends it adds its routes.

        Args:
            listener: The socket to serve on.
            body_max: Maximum size of a request's body, bytes.
        """
        self.listener = listener
        styles = {path.relative_to(WEB).as_posix(): path for path in WEB.rglob("*.css")}
        self._parts = {**styles, **{path.name: path for path in PAGE_SCRIPTS.glob("*.js")}}
        self._app = web.Application(client_max_size=body_max, middlewares=[self._check])
        self._app.on_response_prepare.append(self._secure)

    def add_routes(self, *routes: web.RouteDef) -> None:
        """Adds routes, and behind them those that every server has."""
        common = (web.get("/{code:[A-Za-z]+-?[0-9]{4}}", self._join), web.get("/{name:.+}", self._part))
        self._app.add_routes([*routes, *common])

    @contextlib.asynccontextmanager
    async def listening(self) -> AsyncIterator[logging.Logger]:
        """Answers requests until the context is left; yields the logger of its errors."""
        logger, loop = one_line_logger(sys.stderr), asyncio.get_running_loop()
        loop.set_exception_handler(report_to(logger))
        runner = web.AppRunner(self._app, access_log=None, shutdown_timeout=1.0)
        await runner.setup()
        assert runner.server is not None
        self._connections = Connections(runner.server, HEADERS, logger)
        server = await loop.create_server(self._connections, sock=self.listener.socket)
        try:
            yield logger
        finally:
            server.close()
            await runner.cleanup()
            for handler in logger.handlers:
                handler.close()

    def on_refusal(self) -> None:
        """Called for each request that is refused."""

    def admitted(self, request: web.Request, holds: Callable[[str], bool], *pages: str) -> str:
        """The secret in a request's address, or else in the cookie of one of these pages.

        Raises:
            web.HTTPForbidden: There is none that holds.
        """
        cookies = (request.cookies.get(self._cookie(page), "") for page in pages)
        given = next(filter(holds, (request.query.get("token", ""), *cookies)), None)
        if given is None:
            raise self.refusal("the address must end with ?token=..., as octet printed it")
        return given

    def page(self, request: web.Request, text: str, holds: Callable[[str], bool], *pages: str) -> web.Response:
        """The first of these pages, which removes the secret from its address: its browser keeps it in a cookie."""
        given = self.admitted(request, holds, *pages)
        response = web.Response(text=text, content_type="text/html")
        response.set_cookie(self._cookie(pages[0]), given, httponly=True, samesite="Strict")
        return response

    def check_origin(self, request: web.Request) -> None:
        """Allows only our own page to change anything: any other page in the same browser could try."""
        if request.headers.get("Origin") != f"http://{request.host}":
            raise self.refusal("only octet's own page may connect")

    def refusal(self, why: str) -> web.HTTPForbidden:
        """A refusal in all languages, since no page has determined the reader's yet."""
        self.on_refusal()
        return web.HTTPForbidden(text=_told(why))

    def _cookie(self, page: str) -> str:
        """The cookie of a page: cookies of one address do not tell its ports apart."""
        return f"octet-{self.listener.port}-{page}"

    @web.middleware
    async def _check(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        if not self.listener.is_ours(request.host):
            raise self.refusal("the address must be the one that octet printed")
        if request.method == "POST":
            self.check_origin(request)
        return await handler(request)

    async def _join(self, request: web.Request) -> web.StreamResponse:
        """Redirects a visitor with the correct code to the page."""
        if self.listener.code is None:
            raise web.HTTPNotFound
        try:
            if self.listener.code.opens(request.match_info["code"], request.remote or ""):
                raise web.HTTPFound(f"/?token={self.listener.token}")
        except TooManyGuessesError as error:
            raise web.HTTPTooManyRequests(text=_told(f"{error}")) from None
        raise self.refusal("that is not the code: compare it with the one that octet printed")

    async def _part(self, request: web.Request) -> web.StreamResponse:
        path = self._parts.get(request.match_info["name"])
        if path is None:
            raise web.HTTPNotFound
        return web.FileResponse(path)

    async def _secure(self, request: web.Request, response: web.StreamResponse) -> None:
        response.headers.update(HEADERS)
        if request.path in self.policies:
            response.headers["Content-Security-Policy"] = self.policies[request.path]


def page_text(name: str) -> str:
    """A template with its words in all languages."""
    return with_languages(template(name))


def _told(what: str) -> str:
    return "".join(f"{words.get('refused', {}).get(what, what)}\n" for words in languages().values())
