"""The page server under attack: connections that mean no good, other sites' pages, and what it says of them."""

import http.client
import logging
import os
import stat
from io import StringIO

import pytest

from host_sim.live.connections import one_line_logger
from host_sim.live.listener import Listener
from host_sim.live.token_file import local_token
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


def test_idle_slow_and_malformed_connections_keep_no_page_out(watch):
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
def test_a_page_of_another_site_cannot_come_by_its_own_name(address, host, status):
    assert ask(address, f"/?{address[2]}", host).status == status
    assert ask(address, "/live/live.js", host).status == status


@pytest.mark.parametrize("path", ["/", "/nothing.js", "/?token=guess", "/live", "/../x", "/live/live.js", "/%zz"])
def test_every_answer_has_the_security_headers(address, path):
    response = ask(address, path)

    assert [name for name in SECURITY if response.getheader(name) is None] == []


def test_even_the_answer_to_what_is_no_request_has_them(address):
    connection = http.client.HTTPConnection(address[0], address[1], timeout=DEADLINE_S)
    connection.putrequest("GET", "/", skip_host=True)
    connection.putheader("Content-Length", "-1")
    connection.endheaders()

    response = connection.getresponse()

    assert response.status == 400
    assert [name for name in SECURITY if response.getheader(name) is None] == []
    connection.close()


def test_an_error_is_one_line_and_many_are_a_number():
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


def test_other_machines_are_not_listened_to(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    with Listener(None, 0).socket as listening:
        assert listening.getsockname()[0] == "127.0.0.1"


def test_the_address_always_has_a_token(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    for listen in (None, "127.0.0.1"):
        listener = Listener(listen, 0)
        listener.socket.close()
        assert len(listener.token) >= 22
        assert [url.rpartition("/")[2] for url in listener.urls] == [f"?token={listener.token}"]


def test_the_token_of_this_machine_stays_and_is_for_this_user_alone(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    file = tmp_path / "octet/token"

    assert local_token() == local_token() == file.read_text()
    assert stat.S_IMODE(file.stat().st_mode) == 0o600


@pytest.mark.parametrize("harm", ["others may read it", "no token", "a folder", "a link", "no folder", "a pipe"])
def test_a_token_file_that_is_not_to_be_trusted_is_not_used(monkeypatch, tmp_path, harm):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    file = tmp_path / "octet/token"
    known = local_token()
    if harm == "others may read it":
        file.chmod(0o644)
    elif harm == "no token":
        file.write_text("x")
    else:
        file.unlink()
        if harm == "a folder":
            file.mkdir()
        elif harm == "a pipe":
            os.mkfifo(file, 0o600)
        elif harm == "a link":
            (tmp_path / "known").write_text(known)
            file.symlink_to(tmp_path / "known")
        else:
            file.parent.rmdir()
            file.parent.write_text("in the way")

    assert local_token() != known
    assert len(local_token()) == 22
