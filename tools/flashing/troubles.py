"""Known troubles of flashing: what a program printed, the cause in one sentence, and its remedy.

Texts of openocd 0.11 and 0.12, pyocd 0.36 and stm32flash 0.7, from their sources and from reports of their users.
"""

import re
from typing import NamedTuple


class Trouble(NamedTuple):
    """A trouble that a program's output shows.

    Attributes:
        shown: Pattern of the output.
        remedy: Cause and remedy, for people.
    """

    shown: str
    remedy: str


_RIGHTS = (
    "you have no right to use the probe: call 'sudo usermod -aG plugdev $USER', log in again and plug the probe in"
    " again; docs/hardware.md (When flashing fails) has the udev rules"
)
_PROTECTED = (
    "the chip is read-out protected, so flashing again never helps: unlocking erases all of it; see docs/hardware.md"
    " (When flashing fails)"
)
_NOT_CONNECTED = (
    "the probe does not reach a chip: check the board's power, GND, SWDIO and SWCLK; if they are right, hold the"
    " board's reset button, call again, and let go when the check begins"
)

TROUBLES = (
    Trouble(r"LIBUSB_ERROR_ACCESS|Access denied \(insufficient permissions\)|USBError.*Access denied", _RIGHTS),
    Trouble(
        r"UNEXPECTED idcode: 0x2ba01477",
        "the chip is a clone (IDCODE 0x2ba01477, not ST's 0x1ba01477), on which nothing here was tried: see"
        " docs/hardware.md (When flashing fails) for what it may lack, and how to flash it all the same",
    ),
    Trouble(
        r"device protected|[Rr]ead.?out protect|Device Security Bit Set|flash is locked|RDP level|"
        r"Failed to (?:read memory|erase memory).*\n?.*protect|got NACK from device on command 0x(?:11|31|43|44)",
        _PROTECTED,
    ),
    Trouble(
        r"target voltage may be too low|Target voltage: 0\.[0-4]",
        "the board has no power, or the probe's VTref (3.3 V) is not connected to it: power the board and connect it",
    ),
    Trouble(
        r"Failed to open port|Permission denied.*/dev/tty|/dev/tty\S*: Permission denied",
        "you have no right to open the serial port, or another program holds it: close that one, or call"
        " 'sudo usermod -aG dialout $USER' and log in again",
    ),
    Trouble(
        r"Failed to init device|Failed to get version",
        "the chip's boot loader does not answer: set BOOT0 to 1 (BOOT1 to 0), press reset, check that RX and TX are"
        " crossed, and call again",
    ),
    Trouble(
        r"unable to connect to the target|init mode failed|cannot read IDR|Error connecting DP|"
        r"No ACK received|Could not find MEM-AP|Failed to read memory at 0xe0042000",
        _NOT_CONNECTED,
    ),
    Trouble(
        r"open failed|No available debug probes|No device found",
        "the probe cannot be opened: another program may hold it, or it was just unplugged; close that one, plug the"
        " probe in again, and call again",
    ),
)


def explain(output: str) -> str:
    """The remedy for the first known trouble that an output shows, with its line; else the last line."""
    for trouble in TROUBLES:
        found = re.search(trouble.shown, output)
        if found is not None:
            line = output[output.rfind("\n", 0, found.start()) + 1 :].split("\n", maxsplit=1)[0].strip()
            return f"{trouble.remedy} ({line})"
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    return lines[-1] if lines else "no output"
