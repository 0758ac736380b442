"""The addresses that are printed, and the QR code beside them."""

import fcntl
import ipaddress
import os
import pty
import re
import socket
import struct
import termios
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from types import SimpleNamespace

import pytest

from host_sim.base.errors import UsageError
from host_sim.base.extra_library import library
from host_sim.live import browser, qr_code
from host_sim.live import listener as listener_module
from host_sim.live.listener import Listener, numbers_of
from host_sim.live.qr_code import BORDER, lines_for, modules_of

URL = "http://192.168.100.123:65535/?token=" + 22 * "W"


@pytest.fixture
def terminal() -> Iterator[Callable[..., object]]:
    """Makes terminals of any size and encoding."""
    with ExitStack() as stack:

        def make(columns: int = 80, rows: int = 24, encoding: str = "utf-8") -> object:
            ours, theirs = pty.openpty()
            stack.callback(os.close, ours)
            fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
            return stack.enter_context(os.fdopen(theirs, "w", encoding=encoding))

        yield make


@pytest.fixture(autouse=True)
def xterm(monkeypatch):
    monkeypatch.setenv("TERM", "xterm")


def closed(listen: str | None) -> Listener:
    """One that listens no more."""
    listener = Listener(listen, 0)
    listener.socket.close()
    return listener


def adapters(*numbers: str) -> SimpleNamespace:
    """A library that lists these addresses."""
    ips = [SimpleNamespace(ip=number if "." in number else (number, 0, 0)) for number in numbers]
    return SimpleNamespace(get_adapters=lambda: [SimpleNamespace(ips=ips)])


@pytest.mark.parametrize(
    ("own", "printed"),
    [
        (["127.0.0.1", "192.168.1.7", "::1"], ["192.168.1.7"]),
        (["8.8.4.4", "10.0.0.2", "fe80::1"], ["10.0.0.2", "8.8.4.4"]),
        (["127.0.0.1", "169.254.3.4"], ["127.0.0.1"]),
    ],
)
def test_numbers_of_lists_reachable_ipv4_addresses_private_ones_first(monkeypatch, own, printed):
    monkeypatch.setattr(listener_module, "library", lambda *_: adapters(*own))
    with socket.create_server(("0.0.0.0", 0)) as listening:
        assert numbers_of(listening) == printed


def test_numbers_of_finds_ipv4_addresses_of_this_machine():
    with socket.create_server(("0.0.0.0", 0)) as listening:
        assert all(ipaddress.ip_address(number).version == 4 for number in numbers_of(listening))


def test_listener_on_localhost_prints_the_number_of_its_address():
    listener = closed("localhost")

    assert listener.urls == [f"http://127.0.0.1:{listener.port}/?token={listener.token}"]


def test_board_token_opens_the_board_and_the_page_token_does_not():
    listener = closed("127.0.0.1")

    assert listener.holds(listener.token)
    assert not listener.holds_board(listener.token)
    assert listener.holds(listener.board_token)
    assert listener.holds_board(listener.board_token)
    assert listener.board_url == f"http://127.0.0.1:{listener.port}/board?token={listener.board_token}"


def test_qr_code_fits_an_80_by_24_terminal_beside_other_lines(terminal):
    out = terminal(80, 24)

    lines = lines_for(URL, out)

    assert 15 < len(lines) <= 20
    drawn = [re.sub(r"\x1b\[[\d;]*m", "", line) for line in lines]
    assert {sign for line in drawn for sign in line} == set(" ▀▄█")
    assert {len(line) for line in drawn} == {len(modules_of(URL)) + 2 * BORDER}


def test_qr_code_in_the_terminal_equals_that_on_the_board(terminal):
    drawn = [re.sub(r"\x1b\[[\d;]*m", "", line) for line in lines_for(URL, terminal())]
    halves = {" ": "11", "▀": "01", "▄": "10", "█": "00"}
    rows = [half for line in drawn for half in ("".join(halves[sign][i] for sign in line) for i in (0, 1))]

    inner = [row[BORDER:-BORDER] for row in rows[BORDER : BORDER + len(modules_of(URL))]]

    assert inner == modules_of(URL)


@pytest.mark.parametrize("size", [(30, 24), (80, 20)])
def test_qr_code_is_omitted_where_the_terminal_is_too_small(terminal, size):
    assert lines_for(URL, terminal(*size)) == []


def test_qr_code_is_omitted_where_the_output_cannot_draw_it(terminal, monkeypatch, tmp_path):
    assert lines_for(URL, terminal(encoding="latin-1")) == []
    with (tmp_path / "file").open("w") as file:
        assert lines_for(URL, file) == []
    for term in ("dumb", None):
        monkeypatch.delenv("TERM")
        if term:
            monkeypatch.setenv("TERM", term)
        assert lines_for(URL, terminal()) == []


@pytest.mark.parametrize("listen", [None, "127.0.0.1"])
def test_announcement_names_the_address_and_how_the_run_begins_and_ends(tmp_path, listen):
    listener = closed(listen)
    with (tmp_path / "said").open("w+") as out:
        browser.announce(listener, out, waits=True)
        out.seek(0)
        said = out.read()

    assert listener.urls[0] in said
    assert "Ctrl-C ends it" in said
    assert (f"to type   {listener.short_urls[0]}" in said) == (listen is not None)
    assert ("begins when the page is open" in said) == (listen is None)


def test_listener_names_missing_qr_library_before_the_run(monkeypatch):
    monkeypatch.setattr(qr_code, "library", lambda name, stage: library(f"{name}_that_is_missing", stage))
    with pytest.raises(UsageError, match="run tools/setup classroom"):
        Listener("127.0.0.1", 0)


@pytest.mark.parametrize("name", ["a..b", "x" * 70, "nowhere.invalid"])
def test_listener_refuses_host_name_that_does_not_resolve(name):
    with pytest.raises(UsageError, match=f"cannot listen on {name}, port 0: "):
        Listener(name, 0)
