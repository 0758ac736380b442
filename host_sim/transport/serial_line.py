"""A serial port with an slcan adapter, or with a robot that speaks slcan itself."""

from collections.abc import Sequence

import serial  # type: ignore[import-untyped]  # pyserial has no types

from host_sim.base.errors import LinkDownError, UsageError
from host_sim.transport.link import LineStats
from host_sim.transport.slcan_link import SlcanLink

_BAUD = 115_200
_BIT_RATES = (10_000, 20_000, 50_000, 100_000, 125_000, 250_000, 500_000, 800_000, 1_000_000)
"""In the order of their numbers in slcan's command S."""


def open_serial_line(channel: str, bitrate: int, ids: Sequence[int], stats: LineStats) -> SlcanLink:
    """Opens a serial port and the bus behind it.

    Args:
        channel: The port's device, with `@BAUD` if its speed is not 115200.
        bitrate: Bits a second of the bus.
        ids: The 11-bit identifiers to listen for; none for all.
        stats: Counts what happens to the line.

    Raises:
        UsageError: There is no such port, or it has no such speed.
        LinkDownError: The port is gone again.
    """
    device, at, baud = channel.partition("@")
    if at and not baud.isdecimal():
        raise UsageError(f"a serial port's speed is a number of baud, not {baud!r}")
    try:
        port = serial.Serial(device, int(baud or _BAUD), timeout=0)
    except (serial.SerialException, OSError, ValueError, OverflowError) as error:
        raise UsageError(f"cannot open the bus slcan:{channel}: {str(error).splitlines()[0]}") from error
    # An end of line first, for what may be left of an older one; then close, no time stamps, speed, open.
    try:
        return SlcanLink(port, stats, ids, b"\rC\rZ0\rS%d\rO\r" % _BIT_RATES.index(bitrate))
    except LinkDownError:
        port.close()
        raise
