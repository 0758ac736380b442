"""Opens the link for a bus name from the command line."""

import errno
import logging
import re
import sys
from collections.abc import Sequence
from importlib.metadata import requires
from typing import Any
from urllib.parse import parse_qsl

import can
from can.typechecking import CanFilter

from host_sim.base.errors import LinkDownError, OctetError, UsageError
from host_sim.transport.bus_link import BusLink
from host_sim.transport.link import BIT_RATE, LineStats, Link
from host_sim.transport.slcan_link import open_serial_line

_ID_MASK = 0x7FF
_EXTRAS = {"udp_multicast": "multicast"}
"""Names of python-can's extras that differ from those of their interfaces."""

_STALE_MAX = 10_000
_HINTS = {
    errno.EAFNOSUPPORT: "; this kernel has no CAN: tools/with-vcan COMMAND has a bus, socketcan:vcan0",
    errno.ENODEV: "; `ip link` lists the interfaces that there are",
}
"""Advice by error number."""


def open_bus_link(bus: str, ids: Sequence[int], stats: LineStats, bitrate: int = BIT_RATE) -> Link:
    """Opens a link on a bus: on a serial port for `slcan:DEVICE`, else by python-can.

    Args:
        bus: `INTERFACE:CHANNEL`.
        ids: The 11-bit identifiers to listen for.
        stats: Counts what happens to the line.
        bitrate: Bus bit rate, bit/s, for a bus that is set up when opened.

    Raises:
        UsageError: The name is not one of a bus, or the bus cannot be opened.
        LinkDownError: The bus is there, but down.
    """
    interface, _, channel = bus.partition(":")
    if interface == "slcan" and channel:
        return open_serial_line(channel, bitrate, ids, stats)
    is_socket = interface == "socketcan"
    return BusLink(open_bus(bus, ids, bitrate), stats, is_socket=is_socket, echoes=not is_socket)


def open_bus(bus: str, ids: Sequence[int] = (), bitrate: int = BIT_RATE) -> can.BusABC:
    """Opens a python-can bus.

    Args:
        bus: `INTERFACE:CHANNEL`, with options of the interface as in `socketcand:can0?host=pi&port=29536`.
        ids: The 11-bit identifiers to listen for, none for all; the kernel lets no others through where it can.
        bitrate: Bus bit rate, bit/s, for a bus that is set up when opened.

    Raises:
        UsageError: The name is not one of a bus, or the bus cannot be opened.
        LinkDownError: The bus is there, but down.
    """
    name, _, query = bus.partition("?")
    interface, colon, channel = name.partition(":")
    if not (interface and colon and channel):
        raise UsageError(f"--bus is auto, fd, none or INTERFACE:CHANNEL such as socketcan:vcan0, not {bus!r}")
    filters = [CanFilter(can_id=frame_id, can_mask=_ID_MASK, extended=False) for frame_id in ids]
    extra: dict[str, Any] = {}
    if interface == "slcan":
        # Its default is to sleep for 2 s, for adapters that reset when opened.
        extra["sleep_after_open"] = 0.0
    extra.update({"receive_own_messages": False} if interface == "socketcan" else {"bitrate": bitrate})
    extra.update({option: _value(text) for option, text in parse_qsl(query, keep_blank_values=True)})
    words = _listen_to_python_can()
    try:
        opened = can.Bus(interface=interface, channel=channel, can_filters=filters or None, **extra)
        if filters:
            _forget_unfiltered(opened)
        return opened
    except Exception as error:  # python-can's interfaces raise anything, such as NameError for a missing driver
        raise _not_opened(interface, channel, error, words) from error


def _not_opened(interface: str, channel: str, error: Exception, words: Sequence[str]) -> OctetError:
    """The error to raise, made from python-can's error and its log messages."""
    reason = str(error).splitlines()[0] if str(error) else type(error).__name__
    number = getattr(error, "error_code", None) or getattr(error, "errno", None) or 0
    hint = _HINTS.get(number, "")
    if number == errno.ENETDOWN:
        return LinkDownError(f"the bus {interface}:{channel} is down: {reason}")
    if isinstance(error, NameError | AttributeError):
        reason = f"{words[-1] if words else 'its driver is not installed'} ({reason})"
    if isinstance(error, can.CanInterfaceNotImplementedError | ImportError):
        hint = _missing(interface)
    if isinstance(error, TypeError):
        hint = "; its options follow a question mark, as in --bus 'socketcand:can0?host=pi&port=29536'"
    return UsageError(f"cannot open the bus {interface}:{channel}: {reason}{hint}")


def receive(bus: can.BusABC, timeout_s: float) -> can.Message | None:
    """The next frame of a bus, or None; text of a serial line that is no frame counts as an error frame.

    Raises:
        OctetError: The bus is gone.
    """
    try:
        return bus.recv(timeout_s)
    except ValueError:
        return can.Message(is_error_frame=True)
    except (can.CanError, OSError) as error:
        raise OctetError(f"the bus is gone: {error}") from None


def _forget_unfiltered(bus: can.BusABC) -> None:
    """Discards frames received between binding a socket and setting its filters."""
    try:
        for _ in range(_STALE_MAX):
            if bus.recv(0.0) is None:
                return
    except BaseException:
        bus.shutdown()
        raise


def _value(text: str) -> bool | int | str:
    """The value of an option of an interface: a number or a truth value where it looks like one."""
    if text.lower() in {"true", "false"}:
        return text.lower() == "true"
    return int(text) if text.isdecimal() else text


def _missing(interface: str) -> str:
    """What an interface that cannot be loaded lacks, as the continuation of a sentence."""
    if interface not in can.VALID_INTERFACES:
        return "; name an interface that python-can has, such as socketcan or slcan"
    extra = _EXTRAS.get(interface, interface.replace("_", "-"))
    wanted = [each for each in requires("python-can") or [] if f'extra == "{extra}"' in each]
    packages = ", ".join(re.split(r"[^A-Za-z0-9_-]", each, maxsplit=1)[0] for each in wanted)
    return (
        f"; it needs the package {packages}: {sys.executable} -m pip install 'python-can[{extra}]'"
        if packages
        else ""
    )


def _listen_to_python_can() -> list[str]:
    """Collects python-can's warnings instead of printing them, since its exceptions mostly have the same text."""
    words: list[str] = []
    logger = logging.getLogger("can")
    logger.handlers = [_Words(words)]
    return words


class _Words(logging.Handler):
    """Collects log messages."""

    def __init__(self, words: list[str]) -> None:
        super().__init__(logging.WARNING)
        self._words = words

    def emit(self, record: logging.LogRecord) -> None:
        self._words.append(record.getMessage().rstrip("."))
