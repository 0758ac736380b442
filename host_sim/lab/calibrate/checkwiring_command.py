"""`tools/octet check-wiring`: a guided test of the wiring of a robot that has just been built."""

import argparse
import os

from host_sim.base.errors import LinkDownError, UsageError
from host_sim.cli.parsing import Subparsers, add_command

_EXAMPLES = """\
examples:
  tools/flash pico check
  tools/octet check-wiring /dev/ttyUSB0

The image `check` prints its inputs, and turns a wheel only on request: both wheels stop within 100 ms of the end of
this command, however it ends. A serial terminal at 115200 baud shows the same lines.
"""
_BAUD, _QUIET_S, _END = 115_200, 0.1, b"\r"


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "check-wiring",
        _check_wiring,
        summary="test a new robot's wiring step by step",
        description="Tests a Pico's wiring step by step, and names the wire of an input that does not react.",
        epilog=_EXAMPLES,
        stages=lambda _: ["run"],
    )
    parser.add_argument("port", metavar="PORT", help="serial port on GP0 and GP1, such as /dev/ttyUSB0")


class SerialPort:
    """A serial port as a `Line`."""

    def __init__(self, device: str) -> None:
        """Opens it; raises UsageError if there is no such port."""
        import serial  # type: ignore[import-untyped]  # pyserial has no types

        try:
            self._port = serial.Serial(device, _BAUD, timeout=_QUIET_S, write_timeout=_QUIET_S, exclusive=True)
        except (serial.SerialException, OSError, ValueError) as error:
            raise UsageError(f"cannot open {device}: {_reason(error)}") from error
        self._failures = (serial.SerialException, OSError)
        self._begun = b""

    def read(self) -> bytes:
        """As in `Line`."""
        try:
            self._begun += self._port.read_until(_END)
        except self._failures as error:
            raise LinkDownError(f"the serial port is gone: {error}") from error
        line, end, rest = self._begun.partition(_END)
        self._begun = rest if end else line
        return line if end else b""

    def write(self, text: bytes) -> None:
        """As in `Line`."""
        try:
            self._port.write(text)
        except self._failures as error:
            raise LinkDownError(f"the serial port is gone: {error}") from error

    def close(self) -> None:
        """Closes it."""
        self._port.close()


def _reason(error: Exception) -> str:
    """Why a port could not be opened; pyserial's own words name it and the error a second time."""
    if "ioctl" in str(error):
        return "it is not a serial port"
    number = getattr(error, "errno", None)
    return os.strerror(number) if number else str(error).splitlines()[0]


def _check_wiring(arguments: argparse.Namespace) -> int:
    from contextlib import closing

    from host_sim.lab.calibrate.wiring_check import WiringCheck

    with closing(SerialPort(arguments.port)) as port:
        return int(not WiringCheck(port, lambda text: print(text, flush=True)).run())
