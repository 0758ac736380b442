"""From the name that a person types to an open python-can bus."""

from collections.abc import Sequence
from typing import Any

import can
from can.typechecking import CanFilter

from host_sim.errors import UsageError

BITRATE = 500_000
"""Bits a second, for buses that are set up when opened."""


_ID_MASK = 0x7FF


def open_bus(bus: str, ids: Sequence[int] = ()) -> can.BusABC:
    """Opens a python-can bus.

    Args:
        bus: `INTERFACE:CHANNEL`.
        ids: The 11-bit identifiers to listen for; the kernel or the adapter lets no others through where it can. None
            for all.

    Raises:
        UsageError: The name is not one of a bus, or the bus cannot be opened.
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
        extra["bitrate"] = BITRATE
    try:
        return can.Bus(interface=interface, channel=channel, can_filters=filters or None, **extra)
    except (can.CanError, can.CanInterfaceNotImplementedError, OSError, ValueError, ImportError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise UsageError(f"cannot open the bus {interface}:{channel}: {reason}") from error
