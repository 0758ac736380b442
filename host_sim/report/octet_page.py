"""The page: the robot itself, its world and the laboratory around them, without a server."""

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from host_sim.base.errors import OctetError
from host_sim.base.files import write_bytes
from host_sim.base.paths import PACKAGE, PAGE_WASM
from host_sim.protocol.generated import PARAMETERS
from host_sim.recording.state import measures
from host_sim.report.page_bundle import bundle, packed, packed_page, page_of, with_data
from host_sim.report.speakers import with_speakers
from host_sim.world.names import STILL_WORLDS
from host_sim.world.worlds import world_of

_TEMPLATE, _WORKER = "octet.html", "sim/page_worker.js"
_MARK = '<meta name="octet-class" content="">'
"""An element in the head by which the page knows that it reports to a class."""


def write_octet_page(path: Path) -> int:
    """Writes the page, and returns its size in bytes; equal sources give equal bytes.

    Raises:
        OctetError: The WebAssembly is not built, or the file cannot be written.
    """
    text = packed_page(octet_page()).encode()
    write_bytes(path, text)
    return len(text)


def class_page() -> str:
    """The page of a pupil, which reports to its server.

    Raises:
        OctetError: The WebAssembly is not built.
    """
    allowed = octet_page().replace("default-src 'none';", "default-src 'none'; connect-src 'self';", 1)
    return packed_page(allowed.replace("<title", f"{_MARK}\n<title", 1))


def octet_page(laboratory: Mapping[str, Any] | None = None) -> str:
    """The page's HTML.

    Its element `parts` has the dimensions of all named worlds and the sample programs; `wasm` and `worker`, the
    WebAssembly and the worker's script, packed, and `recorded`, if it is for a recorded run; or `why`, a sentence for
    people, if it is to simulate nothing. Its element `speakers` has the scripts to talk with.

    Args:
        laboratory: How a recorded run is repeated, or why it cannot be: see laboratory.py. None for new runs.

    Raises:
        OctetError: The WebAssembly is not built.
    """
    parts = {"worlds": world_dimensions(), "programs": programs(), **(laboratory or {})}
    if "why" not in parts:
        parts |= {"wasm": packed(_wasm()), "worker": packed(bundle(_WORKER))}
    return with_speakers(with_data(page_of(_TEMPLATE), "parts", parts))


def _wasm() -> bytes:
    try:
        return PAGE_WASM.read_bytes()
    except OSError as error:
        raise OctetError(f"cannot read {PAGE_WASM}: {error.strerror}; build it with tools/setup page") from None


def world_dimensions() -> dict[str, dict[str, Any]]:
    """For each named world: its dimensions, those needed for drawing, and the parameters of its layouts."""
    boredom = PARAMETERS["boredom_limit"].default
    return {
        world.name: {**asdict(world.params), "style": world.style, "measures": measures(world.params, boredom)}
        for world in map(world_of, STILL_WORLDS)
    }


def programs() -> dict[str, str]:
    """The sample programs by name."""
    files = sorted((PACKAGE / "program" / "examples").glob("*.bas"))
    return {path.stem: path.read_text(encoding="utf-8") for path in files}
