"""Paths within the project."""

import re
from pathlib import Path

from host_sim.base.errors import OctetError

PACKAGE = Path(__file__).resolve().parents[1]
"""The folder of the Python files, and of what is read beside them."""

_TREE = PACKAGE / "tree"
INSTALLED = _TREE.is_dir()
"""Whether this was installed as a wheel; otherwise it is a checkout, which tools/setup builds."""

ROOT = _TREE if INSTALLED else PACKAGE.parent
"""The project's root folder, or what a wheel has of it."""

BUILD = ROOT / "build"
"""Build output."""


def project() -> str:
    """The text of pyproject.toml: the project's name, version and extras."""
    return (ROOT / "pyproject.toml").read_text(encoding="utf-8")


def version() -> str:
    """The version of the project."""
    found = re.search(r'^version = "(.+)"$', project(), re.MULTILINE)
    return found[1] if found else "of no version"


_CALLED = {
    r"(run|build (it|them) with) tools/setup( \w+)?": "this wheel was built without it",
    r"\btools/octet\b": "octet",
    r"\btools/run\b": "octet run",
    r"\btools/with-vcan\b": str(ROOT / "tools" / "with-vcan"),
}


def as_called(text: str) -> str:
    """Rewrites the commands in a text for people as they are called here, in a checkout or with a wheel."""
    for checkout, wheel in _CALLED.items() if INSTALLED else ():
        text = re.sub(checkout, wheel.replace("\\", r"\\"), text)
    return text


WEB = PACKAGE / "web"
"""The HTML and CSS of the pages, and in a checkout their TypeScript."""

PAGE_SCRIPTS = BUILD / "web"
"""The programs of the pages, each bundled into one file, from `tools/setup`."""

PAGE_WASM = BUILD / "page" / "host_sim" / "web" / "native" / "page.wasm"
"""Robots and their world as WebAssembly, from `tools/setup page`."""


def image_path(board: str, link: str) -> Path:
    """Path of a firmware image.

    Args:
        board: Name of the board, as in hal/*/boards; also the name of its CMake preset.
        link: A link that its chip has, such as `bxcan` or `slcan`.

    Raises:
        OctetError: The image is not built.
    """
    path = BUILD / board / f"octet-{board}-{link}.elf"
    if not path.exists():
        raise OctetError(f"the image {path} is not built: run tools/setup images")
    return path
