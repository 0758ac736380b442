"""The drive that a Raspberry Pi Pico is while it starts with its BOOTSEL button pressed."""

import os
from pathlib import Path

from tools.flashing import FlashError

MOUNTS = Path("/proc/self/mounts")
_BOARD = "Board-ID: RPI-RP2"
_PRESS = "hold the Pico's BOOTSEL button while you plug in its USB cable, let go, and call again"


def find_drive(mounts: Path = MOUNTS) -> Path:
    """The drive of the only Pico that waits for an image.

    Raises:
        FlashError: There is none, or there are several.
    """
    lines = mounts.read_text().splitlines() if mounts.exists() else []
    places = [Path(line.split()[1].replace("\\040", " ")) for line in lines]
    found = [place for place in places if _BOARD in _about(place)]
    if not found:
        raise FlashError(
            f"no Pico shows up as a drive (RPI-RP2): {_PRESS}; a desktop mounts it, else mount it yourself"
        )
    if len(found) > 1:
        raise FlashError(f"several Picos show up as drives, {', '.join(map(str, found))}: unplug all but one")
    return found[0]


def _about(place: Path) -> str:
    try:
        return (place / "INFO_UF2.TXT").read_text(errors="replace")
    except OSError:
        return ""


def write_to_drive(uf2: Path, drive: Path) -> None:
    """Copies an image; the Pico starts it as soon as it has all blocks.

    Raises:
        FlashError: It cannot be read or written.
    """
    try:
        with (drive / uf2.name).open("wb") as file:
            file.write(uf2.read_bytes())
            file.flush()
            os.fsync(file.fileno())
    except OSError as error:
        raise FlashError(f"cannot copy {uf2} to {drive} ({error.strerror}): {_PRESS}") from error
