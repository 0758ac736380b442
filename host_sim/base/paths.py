"""Paths within the project."""

from pathlib import Path

from host_sim.base.errors import OctetError

ROOT = Path(__file__).resolve().parents[2]
"""The project's root folder."""

BUILD = ROOT / "build"
"""Build output."""

WEB = ROOT / "host_sim" / "web"
"""The HTML, CSS and JavaScript of the pages."""

PAGE_WASM = BUILD / "page" / "host_sim" / "web" / "native" / "page.wasm"
"""Robots and their world as WebAssembly, from `tools/setup page`."""


def image_path(board: str, link: str) -> Path:
    """Path of a firmware image.

    Args:
        board: Name of the board, as in hal/stm32/boards; also the name of its CMake preset.
        link: A link that its chip has, such as `bxcan` or `slcan`.

    Raises:
        OctetError: The image is not built.
    """
    path = BUILD / board / f"octet-{board}-{link}.elf"
    if not path.exists():
        raise OctetError(f"the image {path} is not built: run tools/setup images")
    return path
