"""The page server under attack: connections that mean no good, other sites' pages, and what it says of them."""

import asyncio
import http.client
import logging
from io import StringIO

import aiohttp
import pytest

from host_sim.live.connections import one_line_logger
from host_sim.live.listener import Listener
from tests.web.live.flood import STDERR_MAX, flood
from tests.web.support import DEADLINE_S

SECURITY = ("Content-Security-Policy", "X-Content-Type-Options", "Referrer-Policy", "Cache-Control")


@pytest.fixture(scope="module")
def address(module_watch) -> tuple[str, int, str]:
    host, port = module_watch.url.split("/")[2].split(":")
    return host, int(port), module_watch.url.partition("?")[2]


def ask(address: tuple[str, int, str], path: str, host: str | None = None) -> http.client.HTTPResponse:
    """The answer to one request, read to its end."""
    connection = http.client.HTTPConnection(address[0], address[1], timeout=DEADLINE_S)
    connection.putrequest("GET", path, skip_host=True)
    connection.putheader("Host", host if host is not None else f"{address[0]}:{address[1]}")
    connection.endheaders()
    response = connection.getresponse()
    response.read()
    connection.close()
    return response


def test_idle_slow_and_malformed_connections_do_not_block_pages(watch):
    outcome = flood(watch(), 900)

    assert outcome.served == outcome.asked
    assert len(outcome.stderr) < STDERR_MAX
    assert "Traceback" not in outcome.stderr
    assert 1 < outcome.stderr.count("\n") < 30
    assert all(line.startswith("octet: page server: ") for line in outcome.stderr.splitlines())


@pytest.mark.parametrize(
    ("host", "status"),
    [
        ("localhost:1", 200),
        ("127.0.0.1", 200),
        ("[::1]:8138", 200),
        ("192.168.1.7:8138", 200),
        ("evil.example", 403),
        ("evil.example:8138", 403),
        ("127.0.0.1.evil.example", 403),
        ("localhost.evil.example", 403),
        ("", 403),
    ],
)
def test_request_with_a_foreign_host_header_is_refused(address, host, status):
    assert ask(address, f"/?{address[2]}", host).status == status
    assert ask(address, "/octet.js", host).status == status


@pytest.mark.parametrize("path", ["/", "/nothing.js", "/?token=guess", "/live", "/../x", "/octet.js", "/%zz"])
def test_answers_have_the_security_headers(address, path):
    response = ask(address, path)

    assert [name for name in SECURITY if response.getheader(name) is None] == []


def test_security_policy_allows_only_scripts_of_the_server(address):
    policy = ask(address, f"/?{address[2]}").getheader("Content-Security-Policy")
    scripts, styles = "script-src 'self' 'wasm-unsafe-eval'; worker-src blob:", "style-src 'self'; connect-src 'self'"

    assert f"; {scripts}; {styles}; " in policy
    assert policy.startswith("default-src 'none'; ")


def test_answer_to_a_malformed_request_has_the_security_headers(address):
    connection = http.client.HTTPConnection(address[0], address[1], timeout=DEADLINE_S)
    connection.putrequest("GET", "/", skip_host=True)
    connection.putheader("Content-Length", "-1")
    connection.endheaders()

    response = connection.getresponse()

    assert response.status == 400
    assert [name for name in SECURITY if response.getheader(name) is None] == []
    connection.close()


def test_errors_are_one_line_each_and_further_ones_are_counted():
    out = StringIO()
    logger = one_line_logger(out)
    for i in range(100):
        logger.error("Error handling request", exc_info=ValueError(f"two\nlines \x1b[31m {i}"))
    for handler in logger.handlers:
        handler.close()

    lines = out.getvalue().splitlines()
    assert len(lines) == 21
    assert lines[0].startswith("octet: page server: Error handling request: ValueError(")
    assert lines[-1] == "octet: page server: 80 further errors"
    assert out.getvalue().isascii()
    assert "\x1b" not in out.getvalue()
    assert isinstance(logger, logging.Logger)


def test_listener_binds_to_the_loopback_interface_by_default():
    with Listener(None, 0).socket as listening:
        assert listening.getsockname()[0] == "127.0.0.1"


def test_page_address_always_has_a_token():
    for listen in (None, "127.0.0.1"):
        listener = Listener(listen, 0)
        listener.socket.close()
        assert len(listener.token) >= 22
        assert [url.rpartition("/")[2] for url in listener.urls] == [f"?token={listener.token}"]


def test_token_is_new_for_each_run():
    tokens = set()
    for _ in range(2):
        listener = Listener(None, 0)
        listener.socket.close()
        tokens.add(listener.token)

    assert len(tokens) == 2


def test_page_cookie_reopens_the_page_and_is_http_only_and_same_site(module_watch):
    home = module_watch.url.partition("?")[0]

    async def statuses() -> list[int]:
        found = []
        async with aiohttp.ClientSession(cookie_jar=aiohttp.CookieJar(unsafe=True)) as session:
            for url in (home, module_watch.url, home):
                async with session.get(url) as response:
                    found.append(response.status)
            cookie = next(iter(session.cookie_jar))
            assert cookie["httponly"]
            assert cookie["samesite"] == "Strict"
            return found

    assert asyncio.run(statuses()) == [403, 200, 200]
