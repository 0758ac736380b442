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
def test_the_addresses_are_those_of_this_machines_networks_by_number(monkeypatch, own, printed):
    monkeypatch.setattr(listener_module, "library", lambda *_: adapters(*own))
    with socket.create_server(("0.0.0.0", 0)) as listening:
        assert numbers_of(listening) == printed


def test_this_machines_own_addresses_are_numbers():
    with socket.create_server(("0.0.0.0", 0)) as listening:
        assert all(ipaddress.ip_address(number).version == 4 for number in numbers_of(listening))


def test_one_address_is_itself_however_it_was_named():
    listener = Listener("localhost", 0)
    listener.socket.close()

    assert listener.urls == [f"http://127.0.0.1:{listener.port}/?token={listener.token}"]


def test_the_board_has_a_secret_of_its_own_where_others_can_come():
    listener = Listener("127.0.0.1", 0)
    listener.socket.close()

    assert listener.holds(listener.token)
    assert not listener.holds_board(listener.token)
    assert listener.holds(listener.board_token)
    assert listener.holds_board(listener.board_token)
    assert listener.board_url == f"http://127.0.0.1:{listener.port}/board?token={listener.board_token}"


def test_the_code_fits_a_terminal_with_the_lines_beside_it(terminal):
    out = terminal(80, 24)

    lines = lines_for(URL, out)

    assert 15 < len(lines) <= 20
    drawn = [re.sub(r"\x1b\[[\d;]*m", "", line) for line in lines]
    assert {sign for line in drawn for sign in line} == set(" ▀▄█")
    assert {len(line) for line in drawn} == {len(modules_of(URL)) + 2 * BORDER}


def test_the_code_in_the_terminal_is_that_on_the_board(terminal):
    drawn = [re.sub(r"\x1b\[[\d;]*m", "", line) for line in lines_for(URL, terminal())]
    halves = {" ": "11", "▀": "01", "▄": "10", "█": "00"}
    rows = [half for line in drawn for half in ("".join(halves[sign][i] for sign in line) for i in (0, 1))]

    inner = [row[BORDER:-BORDER] for row in rows[BORDER : BORDER + len(modules_of(URL))]]

    assert inner == modules_of(URL)


@pytest.mark.parametrize("size", [(30, 24), (80, 20)])
def test_there_is_no_code_where_it_would_not_fit(terminal, size):
    assert lines_for(URL, terminal(*size)) == []


def test_there_is_no_code_where_it_could_not_be_read(terminal, monkeypatch, tmp_path):
    assert lines_for(URL, terminal(encoding="latin-1")) == []
    with (tmp_path / "file").open("w") as file:
        assert lines_for(URL, file) == []
    for term in ("dumb", None):
        monkeypatch.delenv("TERM")
        if term:
            monkeypatch.setenv("TERM", term)
        assert lines_for(URL, terminal()) == []


@pytest.mark.parametrize("listen", [None, "127.0.0.1"])
def test_what_it_waits_for_is_said(tmp_path, listen):
    listener = Listener(listen, 0)
    listener.socket.close()
    with (tmp_path / "said").open("w+") as out:
        browser.announce(listener, out, waits=True)
        out.seek(0)
        said = out.read()

    assert listener.urls[0] in said
    assert "Ctrl-C ends it" in said
    assert (f"to type   {listener.short_urls[0]}" in said) == (listen is not None)
    assert ("begins when the page is open" in said) == (listen is None)


def test_a_library_that_is_missing_is_named_before_the_run(monkeypatch):
    monkeypatch.setattr(qr_code, "library", lambda name, stage: library(f"{name}_that_is_missing", stage))
    with pytest.raises(UsageError, match="run tools/setup classroom"):
        Listener("127.0.0.1", 0)


@pytest.mark.parametrize("name", ["a..b", "x" * 70, "nowhere.invalid"])
def test_a_name_that_no_machine_can_have_is_no_address(name):
    with pytest.raises(UsageError, match=f"cannot listen on {name}, port 0: "):
        Listener(name, 0)
