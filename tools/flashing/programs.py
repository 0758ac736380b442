"""The programs that write to a chip: openocd, pyocd, and stm32flash for the serial boot loader.

They erase only the pages that the image needs, so the robot keeps its memory.
"""

import re
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from host_sim.base.errors import OctetError
from tools.flashing.images import Image
from tools.flashing.probes import Probe


class Problem(NamedTuple):
    """A problem that a program's output shows.

    Texts of openocd 0.11 and 0.12, pyocd 0.36 and stm32flash 0.7, from their sources and from reports of their users.

    Attributes:
        shown: Pattern of the output.
        remedy: Cause and remedy, for people.
    """

    shown: str
    remedy: str


_RIGHTS = (
    "you have no permission for the probe: run 'sudo usermod -aG plugdev $USER', log in again and plug the probe in"
    " again; docs/hardware.md (When flashing fails) has the udev rules"
)
_PROTECTED = (
    "the chip is read-out protected, so flashing again cannot help: unlocking erases all of it; see docs/hardware.md"
    " (When flashing fails)"
)
_NOT_CONNECTED = (
    "the probe does not reach a chip: check the board's power, GND, SWDIO and SWCLK; if they are right, hold the"
    " board's reset button, try again, and let go when the check begins"
)

PROBLEMS = (
    Problem(r"LIBUSB_ERROR_ACCESS|Access denied \(insufficient permissions\)|USBError.*Access denied", _RIGHTS),
    Problem(
        r"UNEXPECTED idcode: 0x2ba01477",
        "the chip is a clone (IDCODE 0x2ba01477, not ST's 0x1ba01477), on which nothing here was tested: see"
        " docs/hardware.md (When flashing fails) for what it may lack, and how to flash it anyway",
    ),
    Problem(
        r"device protected|[Rr]ead.?out protect|Device Security Bit Set|flash is locked|RDP level|"
        r"Failed to (?:read memory|erase memory).*\n?.*protect|got NACK from device on command 0x(?:11|31|43|44)",
        _PROTECTED,
    ),
    Problem(
        r"target voltage may be too low|Target voltage: 0\.[0-4]",
        "the board has no power, or the probe's VTref (3.3 V) is not connected to it: power the board and connect it",
    ),
    Problem(
        r"Failed to open port|Permission denied.*/dev/tty|/dev/tty\S*: Permission denied",
        "you have no permission to open the serial port, or another program holds it: close that one, or run"
        " 'sudo usermod -aG dialout $USER' and log in again",
    ),
    Problem(
        r"Failed to init device|Failed to get version",
        "the chip's boot loader does not answer: set BOOT0 to 1 (BOOT1 to 0), press reset, check that RX and TX are"
        " crossed, and try again",
    ),
    Problem(
        r"unable to connect to the target|init mode failed|cannot read IDR|Error connecting DP|"
        r"No ACK received|Could not find MEM-AP|Failed to read memory at 0xe0042000",
        _NOT_CONNECTED,
    ),
    Problem(
        r"open failed|No available debug probes|No device found",
        "the probe cannot be opened: another program may hold it, or it was just unplugged; close that one, plug the"
        " probe in again, and try again",
    ),
)


def explain(output: str) -> str:
    """The remedy for the first known problem in the output, and the line that shows it; else the last line."""
    for problem in PROBLEMS:
        found = re.search(problem.shown, output)
        if found is not None:
            line = output[output.rfind("\n", 0, found.start()) + 1 :].split("\n", maxsplit=1)[0].strip()
            return f"{problem.remedy} ({line})"
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    return lines[-1] if lines else "no output"


CHIP_IDS = {"stm32f405": 0x413, "stm32f103": 0x410, "stm32g431": 0x468, "rp2040": 0x927}
"""Bits 0..11 of DBGMCU_IDCODE: RM0090 38.6.1, RM0008 31.6.1, RM0440 47.6.1; of CHIP_ID: RP2040 data sheet 2.20."""

_IDCODES = {"rp2040": "0x40000000"}
_IDCODE = "0xE0042000"
_TARGETS = {
    "stm32f405": ("stm32f4x", "stm32f405rg"),
    "stm32f103": ("stm32f1x", "stm32f103c8"),
    "stm32g431": ("stm32g4x", "stm32g431rb"),
    "rp2040": ("rp2040", "rp2040"),
}
_TIMEOUT_S = 120

Command = list[str]


@dataclass(frozen=True)
class Plan:
    """The commands that will be run.

    Attributes:
        program: Name of the program.
        ask: Command that prints the chip's identity.
        answer: Pattern of the identity in the output.
        write: Command that writes, verifies and starts the image.
    """

    program: str
    ask: Command
    answer: re.Pattern[str]
    write: Command


def _idcode(image: Image) -> str:
    return _IDCODES.get(image.chip, _IDCODE)


def _openocd(image: Image, probe: Probe) -> Plan:
    serial = ["-c", f"adapter serial {probe.where}"] if probe.where else []
    interface = ["-f", f"interface/{probe.kind}.cfg", *serial]
    transport = [] if probe.kind == "stlink" else ["-c", "transport select swd"]
    command = ["openocd", *interface, *transport, "-f", f"target/{_TARGETS[image.chip][0]}.cfg"]
    ask = [*command, "-c", f"init; echo [format chip=0x%x [read_memory {_idcode(image)} 32 1]]; shutdown"]
    write = [*command, "-c", f"program {{{image.path}}} verify reset exit"]
    return Plan("openocd", ask, re.compile(r"chip=0x([0-9a-f]+)"), write)


def _pyocd(image: Image, probe: Probe) -> Plan:
    which = ["-u", probe.where] if probe.where else []
    ask = ["pyocd", "commander", *which, "-t", "cortex_m", "-c", f"read32 {_idcode(image)}"]
    write = ["pyocd", "load", *which, "-t", _TARGETS[image.chip][1], "--erase", "sector", str(image.path)]
    return Plan("pyocd", ask, re.compile(r"[0-9a-f]{8}: +([0-9a-f]{8})", re.IGNORECASE), write)


def _stm32flash(image: Image, probe: Probe) -> Plan:
    write = ["stm32flash", "-w", str(image.path.with_suffix(".bin")), "-v", "-g", "0x08000000", probe.where]
    return Plan("stm32flash", ["stm32flash", probe.where], re.compile(r"Device ID +: 0x([0-9a-f]+)"), write)


_FOR_SERIAL = {"stm32flash": _stm32flash}
_FOR_DEBUG_PROBES = {"openocd": _openocd, "pyocd": _pyocd}


def make_plan(image: Image, probe: Probe, has: Callable[[str], object] = shutil.which) -> Plan:
    """Plans how to write an image through a probe.

    Args:
        image: The image.
        probe: The probe.
        has: Tells whether a program is installed.

    Raises:
        OctetError: No program for the probe is installed.
    """
    if probe.kind == "serial" and image.chip in _IDCODES:
        raise OctetError(f"an {image.chip} has no boot loader on a serial port: leave --probe out")
    makers = _FOR_SERIAL if probe.kind == "serial" else _FOR_DEBUG_PROBES
    for program, make in makers.items():
        if has(program):
            return make(image, probe)
    raise OctetError(f"{probe.kind} needs {' or '.join(makers)}, which is not installed")


def _run(command: Command) -> tuple[int, str]:
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=_TIMEOUT_S)
    except subprocess.TimeoutExpired as error:
        raise OctetError(f"{command[0]} did not end within {_TIMEOUT_S} s") from error
    return done.returncode, done.stdout + done.stderr


def check_chip(plan: Plan, chip: str) -> None:
    """Checks that the chip behind the probe is the one that the image is for.

    Raises:
        OctetError: It is another chip, or does not answer.
    """
    code, output = _run(plan.ask)
    found = plan.answer.search(output)
    if found is None:
        raise OctetError(f"{plan.program} finds no chip (exit code {code}): {explain(output)}")
    identity = int(found[1], 16) & 0xFFF
    if identity != CHIP_IDS[chip]:
        raise OctetError(f"the chip behind the probe is 0x{identity:03X}, not {chip} (0x{CHIP_IDS[chip]:03X})")


def write(plan: Plan) -> None:
    """Writes the image.

    Raises:
        OctetError: It failed; the chip's content is undefined.
    """
    code, output = _run(plan.write)
    if code != 0:
        raise OctetError(f"{plan.program} did not write the image (exit code {code}): {explain(output)}")
