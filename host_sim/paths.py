"""Where things are in the project's folder."""

from pathlib import Path

from host_sim.errors import OctetError

ROOT = Path(__file__).resolve().parent.parent
"""The folder of the project."""

BUILD = ROOT / "build"
"""What is made when building."""

WEB = ROOT / "host_sim" / "web"
"""The page's own files."""


def image_path(board: str, link: str) -> Path:
    """Where an image is.

    Args:
        board: Its name, as in hal/stm32/boards: a preset of CMake.
        link: One that its chip has, such as `bxcan` or `slcan`.

    Raises:
        OctetError: It is not built.
    """
    path = BUILD / board / f"octet-{board}-{link}.elf"
    if not path.exists():
        raise OctetError(f"the image {path} is not built: run tools/setup images")
    return path
