"""Opens the link for a bus name from the command line."""

import errno
import logging
from collections.abc import Sequence
from typing import Any

import can
from can.typechecking import CanFilter

from host_sim.base.errors import LinkDownError, OctetError, UsageError
from host_sim.transport.bit_rates import BIT_RATE
from host_sim.transport.bus_link import BusLink
from host_sim.transport.line_stats import LineStats
from host_sim.transport.link import Link
from host_sim.transport.serial_line import open_serial_line

_ID_MASK = 0x7FF
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
        bitrate: Bits a second, for a bus that is set up when opened.

    Raises:
        UsageError: The name is not one of a bus, or the bus cannot be opened.
        LinkDownError: The bus is there, but down.
    """
    interface, _, channel = bus.partition(":")
    if interface == "slcan" and channel:
        return open_serial_line(channel, bitrate, ids, stats)
    return BusLink(open_bus(bus, ids, bitrate), stats, is_socket=interface == "socketcan")


def open_bus(bus: str, ids: Sequence[int] = (), bitrate: int = BIT_RATE) -> can.BusABC:
    """Opens a python-can bus.

    Args:
        bus: `INTERFACE:CHANNEL`.
        ids: The 11-bit identifiers to listen for, none for all; the kernel lets no others through where it can.
        bitrate: Bits a second, for a bus that is set up when opened.

    Raises:
        UsageError: The name is not one of a bus, or the bus cannot be opened.
        LinkDownError: The bus is there, but down.
    """
    interface, colon, channel = bus.partition(":")
    if not (interface and colon and channel):
        raise UsageError(f"--bus is auto, fd, none or INTERFACE:CHANNEL such as socketcan:vcan0, not {bus!r}")
    filters = [CanFilter(can_id=frame_id, can_mask=_ID_MASK, extended=False) for frame_id in ids]
    extra: dict[str, Any] = {}
    if interface == "slcan":
        # Its default is to sleep for 2 s, for adapters that reset when opened.
        extra["sleep_after_open"] = 0.0
    if interface != "socketcan":
        extra["bitrate"] = bitrate
    _silence_python_can()
    try:
        opened = can.Bus(interface=interface, channel=channel, can_filters=filters or None, **extra)
        if filters:
            _forget_unfiltered(opened)
        return opened
    except (can.CanError, can.CanInterfaceNotImplementedError, OSError, ValueError, TypeError, ImportError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        if errno.ENETDOWN in (getattr(error, "error_code", None), getattr(error, "errno", None)):
            raise LinkDownError(f"the bus {interface}:{channel} is down: {reason}") from error
        hint = _HINTS.get(getattr(error, "error_code", None) or getattr(error, "errno", None) or 0, "")
        if isinstance(error, can.CanInterfaceNotImplementedError):
            hint = "; name an interface that python-can has, such as socketcan or slcan"
        raise UsageError(f"cannot open the bus {interface}:{channel}: {reason}{hint}") from error


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


def _silence_python_can() -> None:
    """Silences python-can's logging, since its exceptions carry the same text in one line."""
    logger = logging.getLogger("can")
    if not logger.handlers:
        logger.addHandler(logging.NullHandler())
