"""The listening socket of the page server, and the addresses and secrets by which it is reached."""

import ipaddress
import os
import secrets
import socket

from yarl import URL

from host_sim.base.errors import UsageError
from host_sim.base.extra_library import library
from host_sim.live.join_code import JoinCode
from host_sim.live.qr_code import modules_of

ANYWHERE = ("0.0.0.0", "::")
"""The addresses of all networks."""

_Address = ipaddress.IPv4Address | ipaddress.IPv6Address


class Listener:
    """The listening socket of the server, opened before the run, so that a port in use cannot spoil it.

    Attributes:
        host: Address that it listens on.
        port: Port that it listens on.
        is_open: Whether other machines can connect.
        token: Secret of this run that a page's address must contain: other users of this machine can connect, too.
        board_token: Secret that the board's address must contain, which only its owner is told.
        socket: The socket.
        urls: The page's addresses with numbers for the host, one for each network of this machine.
        code: The code that makes a page's address short enough to type; None for this machine only.
        short_urls: The address with the code for each of `urls`; `urls` if there is no code.
        board_url: The board's address.
        qr_modules: The first of the page's addresses as a QR code: see `modules_of`; empty for this machine only.
    """

    def __init__(self, listen: str | None, port: int) -> None:
        """Opens the socket.

        Args:
            listen: Address to listen on for other machines; None for this machine only.
            port: Port to listen on; 0 for any free port.

        Raises:
            UsageError: The address does not exist or is in use, or a library for `--listen` is not installed.
        """
        self.host = listen or "127.0.0.1"
        self.is_open = listen is not None
        self.token = secrets.token_urlsafe(16)
        self.board_token = secrets.token_urlsafe(16) if listen else self.token
        self.code = JoinCode() if listen else None
        try:
            family, *_, address = socket.getaddrinfo(self.host, port, type=socket.SOCK_STREAM)[0]
            self.socket = socket.create_server((address[0], port), family=family)
        except (OSError, UnicodeError) as error:  # UnicodeError: not a name that can be looked up
            where = f"{self.host}, port {port}"
            raise UsageError(
                f"cannot listen on {where}: {_reason(error)}; choose another with --port or --listen"
            ) from None
        self.port: int = self.socket.getsockname()[1]
        try:
            self._name()
        except UsageError:
            self.socket.close()
            raise

    def _name(self) -> None:
        """Determines the addresses by which others reach the socket."""
        numbers = numbers_of(self.socket)
        homes = [f"[{number}]:{self.port}" if ":" in number else f"{number}:{self.port}" for number in numbers]
        self.urls = [f"http://{home}/?token={self.token}" for home in homes]
        self.short_urls = [f"{home}/{self.code.text}" for home in homes] if self.code else self.urls
        self.board_url = f"http://{homes[0]}/board?token={self.board_token}"
        self.qr_modules = modules_of(self.urls[0]) if self.is_open else []

    def holds(self, given: str) -> bool:
        """Whether a secret opens the page."""
        return _is_same(given, self.token) or self.holds_board(given)

    def holds_board(self, given: str) -> bool:
        """Whether a secret opens the board, and the page with all rights."""
        return _is_same(given, self.board_token)

    def is_ours(self, host: str) -> bool:
        """Whether a request's Host header is an address, or a name of this machine that the user knows.

        A page of another site can have its own name resolve to this machine (DNS rebinding); its requests then come
        with that name.
        """
        name = _host_name(host)
        return name in ("localhost", self.host.lower(), socket.gethostname().lower()) or _is_address(name)


def _reason(error: OSError | UnicodeError) -> str:
    if isinstance(error, (UnicodeError, socket.gaierror)) or error.errno is None:
        return "no such address"
    return os.strerror(error.errno).lower()


def _is_same(given: str, secret: str) -> bool:
    return secrets.compare_digest(given.encode(), secret.encode())


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


def numbers_of(listening: socket.socket) -> list[str]:
    """The addresses at which a listening socket can be reached, those of other machines' networks first.

    Raises:
        UsageError: The library that lists the networks is not installed.
    """
    host = str(listening.getsockname()[0])
    if host not in ANYWHERE:
        return [host]
    kind = ipaddress.IPv6Address if listening.family is socket.AF_INET6 else ipaddress.IPv4Address
    return [str(it) for it in sorted(_own(kind), key=lambda it: not it.is_private)]


def _own(kind: type[_Address]) -> list[_Address]:
    """The addresses in all networks with other machines; that of this machine alone if there is none."""
    adapters = library("ifaddr", "classroom").get_adapters()
    texts = [ip.ip if isinstance(ip.ip, str) else ip.ip[0] for adapter in adapters for ip in adapter.ips]
    found = [ipaddress.ip_address(text) for text in texts]
    others = [it for it in found if isinstance(it, kind) and not (it.is_loopback or it.is_link_local)]
    return others or [kind("::1" if kind is ipaddress.IPv6Address else "127.0.0.1")]
