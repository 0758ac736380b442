"""Debug probes on USB, and the chips' own serial boot loader."""

import os
from dataclasses import dataclass
from pathlib import Path

from host_sim.base.errors import OctetError, UsageError

USB = Path("/sys/bus/usb/devices")
KINDS = ("stlink", "cmsis-dap", "jlink", "serial")
_ST, _SEGGER = "0483", "1366"
_STLINK_PRODUCTS = ("3744", "3748", "374a", "374b", "374d", "374e", "374f", "3752", "3753", "3754", "3757")


@dataclass(frozen=True)
class Probe:
    """A debug probe or a serial port.

    Attributes:
        kind: One of KINDS.
        where: Its serial number; for "serial", the device's path.
    """

    kind: str
    where: str

    def __str__(self) -> str:
        """The probe as --probe names it."""
        return f"{self.kind}:{self.where}"


def _read(device: Path, name: str) -> str:
    try:
        return (device / name).read_text().strip()
    except OSError:
        return ""


def _kind_of(device: Path) -> str | None:
    vendor, product = _read(device, "idVendor"), _read(device, "idProduct")
    if vendor == _ST and product in _STLINK_PRODUCTS:
        return "stlink"
    if vendor == _SEGGER:
        return "jlink"
    return "cmsis-dap" if "CMSIS-DAP" in _read(device, "product") else None


def find_probes(usb: Path = USB) -> list[Probe]:
    """Every debug probe that is plugged in."""
    devices = sorted(usb.iterdir()) if usb.is_dir() else []
    kinds = ((device, _kind_of(device)) for device in devices)
    return [Probe(kind, _read(device, "serial")) for device, kind in kinds if kind is not None]


def choose_probe(wanted: str | None, found: list[Probe]) -> Probe:
    """The probe to use.

    Args:
        wanted: KIND or KIND:WHERE; None for the only probe there is.
        found: The probes that are plugged in.

    Raises:
        OctetError: There is no such probe, or several.
    """
    kind, _, where = (wanted or "").partition(":")
    if kind and kind not in KINDS:
        raise UsageError(f"no kind of probe {kind}; there are {', '.join(KINDS)}")
    if kind == "serial":
        if not where or not Path(where).exists():
            raise UsageError(f"--probe serial:PATH: no such device: {where or 'PATH is missing'}")
        return Probe(kind, where)
    fitting = [probe for probe in found if kind in ("", probe.kind) and where in ("", probe.where)]
    if not fitting:
        missing = f"no probe {wanted}" if wanted else "no debug probe"
        raise OctetError(f"{missing} is plugged in; for the chip's own boot loader: --probe serial:/dev/ttyUSB0")
    if len(fitting) > 1:
        raise OctetError(f"several probes: choose one with --probe: {', '.join(str(probe) for probe in fitting)}")
    return fitting[0]


MOUNTS = Path("/proc/self/mounts")
_BOARD = "Board-ID: RPI-RP2"
_PRESS = "hold the Pico's BOOTSEL button while you plug in its USB cable, let go, and call again"


def find_drive(mounts: Path = MOUNTS) -> Path:
    """The drive of the only Pico that waits for an image.

    Raises:
        OctetError: There is none, or there are several.
    """
    lines = mounts.read_text().splitlines() if mounts.exists() else []
    places = [Path(line.split()[1].replace("\\040", " ")) for line in lines]
    found = [place for place in places if _BOARD in _about(place)]
    if not found:
        raise OctetError(
            f"no Pico shows up as a drive (RPI-RP2): {_PRESS}; a desktop mounts it, else mount it yourself"
        )
    if len(found) > 1:
        raise OctetError(f"several Picos show up as drives, {', '.join(map(str, found))}: unplug all but one")
    return found[0]


def _about(place: Path) -> str:
    try:
        return (place / "INFO_UF2.TXT").read_text(errors="replace")
    except OSError:
        return ""


def write_to_drive(uf2: Path, drive: Path) -> None:
    """Copies an image; the Pico starts it as soon as it has all blocks.

    Raises:
        OctetError: It cannot be read or written.
    """
    try:
        with (drive / uf2.name).open("wb") as file:
            file.write(uf2.read_bytes())
            file.flush()
            os.fsync(file.fileno())
    except OSError as error:
        raise OctetError(f"cannot copy {uf2} to {drive} ({error.strerror}): {_PRESS}") from error
