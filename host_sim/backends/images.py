"""Where the build leaves the images that are flashed."""

from pathlib import Path

from host_sim.errors import OctetError
from host_sim.paths import BUILD

BOARDS = ("stm32f405", "stm32f103")
"""Boards that can be emulated."""


def image_path(board: str, link: str) -> Path:
    """Where an image is.

    Args:
        board: `stm32f405` or `stm32f103`: a preset of CMake.
        link: `bxcan` or `slcan`.

    Raises:
        OctetError: It is not built.
    """
    path = BUILD / board / f"octet-{board}-{link}.elf"
    if not path.exists():
        raise OctetError(f"the image {path} is not built: run tools/setup images")
    return path
