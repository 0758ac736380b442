"""This machine's addresses, by number: what a phone can open without a name server."""

import ipaddress
import socket

from host_sim.base.extra_library import library

ANYWHERE = ("0.0.0.0", "::")
"""The addresses of all networks."""

_Address = ipaddress.IPv4Address | ipaddress.IPv6Address


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
    """The addresses of all networks that others can be in; that of this machine alone if there is none."""
    adapters = library("ifaddr", "classroom").get_adapters()
    texts = [ip.ip if isinstance(ip.ip, str) else ip.ip[0] for adapter in adapters for ip in adapter.ips]
    found = [ipaddress.ip_address(text) for text in texts]
    others = [it for it in found if isinstance(it, kind) and not (it.is_loopback or it.is_link_local)]
    return others or [kind("::1" if kind is ipaddress.IPv6Address else "127.0.0.1")]
