"""The page: the robot itself, its world and the laboratory around them, without a server."""

import csv
import re
from collections.abc import Mapping
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import Any

from host_sim.base.errors import OctetError
from host_sim.base.files import write_bytes
from host_sim.base.paths import PACKAGE, PAGE_SCRIPTS, PAGE_WASM, ROOT, as_called
from host_sim.protocol.generated import PARAMETERS
from host_sim.recording.state import measures
from host_sim.report.laboratory import NO_FIRMWARE
from host_sim.report.page_bundle import packed, packed_page, page_of, script, with_data
from host_sim.talk.conversation import SPEAKERS, script_named, texts_of
from host_sim.talk.languages import as_script, template, with_languages
from host_sim.world.names import STILL_WORLDS
from host_sim.world.worlds import world_of

_TEMPLATE, _SCRIPT, _WORKER = "octet.html", "octet.js", "page_worker.js"
_PICO_SCRIPT, _PICO_WORKER = "octet_pico.js", "pico_worker.js"
_POLICY = re.compile(r"<meta http-equiv[^\n]*\n")
_MARK = '<meta name="octet-class" content="">'
"""An element in the head by which the page knows that it reports to a class."""


def write_octet_page(path: Path, pico: bytes | None = None) -> int:
    """Writes the page, and returns its size in bytes; equal sources give equal bytes.

    Args:
        path: The file.
        pico: The flash image of a Pico, if the page is to run one.

    Raises:
        OctetError: The WebAssembly or a script is not built, or the file cannot be written.
    """
    text = packed_page(octet_page() if pico is None else _pico_page(pico)).encode()
    write_bytes(path, text)
    return len(text)


def class_page() -> str:
    """The page of a pupil, which reports to its server.

    Raises:
        OctetError: The WebAssembly or a script is not built.
    """
    allowed = octet_page().replace("default-src 'none';", "default-src 'none'; connect-src 'self';", 1)
    return packed_page(allowed.replace("<title", f"{_MARK}\n<title", 1))


def live_page(profile: str = "", settings: Mapping[str, int] | None = None) -> str:
    """The page of a live run, for a server with a policy of its own, which serves the script as well.

    Args:
        profile: The behaviour with which its robots start; empty if it is not known.
        settings: Their parameters, but for those with default values.

    Raises:
        OctetError: The script is not built.
    """
    script(_SCRIPT)
    html = _POLICY.sub("", with_languages(template(_TEMPLATE)))
    why = {} if PAGE_WASM.exists() else NO_FIRMWARE
    return _with_parts(html, {"live": {"profile": profile, "settings": settings or {}}, **why})


def octet_page(laboratory: Mapping[str, Any] | None = None) -> str:
    """The page's HTML.

    Its element `parts` has the dimensions of all named worlds, the sample programs, the debugger's command and the
    mean times of all memories (`atlas`); `live`, how the robots of a live run start; `wasm`, the WebAssembly,
    packed, `worker`, the worker's script, and `recorded`, if it is for a recorded run; or `why`, a sentence for
    people, if it is to simulate nothing. Its element `speakers` has the scripts to talk with.

    Args:
        laboratory: How a recorded run is repeated, or why it cannot be: see laboratory.py. None for new runs.

    Raises:
        OctetError: The WebAssembly or a script is not built.
    """
    return _with_parts(page_of(template(_TEMPLATE)), laboratory or {})


def _pico_page(image: bytes) -> str:
    """The page, with what runs a flash image in rp2040js."""
    if not (PAGE_SCRIPTS / _PICO_WORKER).exists():
        raise OctetError("page --pico needs rp2040js, which is not installed: run tools/setup pico")
    text = template(_TEMPLATE).replace(_SCRIPT, _PICO_SCRIPT).replace('data-parts="', 'data-parts="pico ', 1)
    return _with_parts(page_of(text), {"pico": {"worker": packed(script(_PICO_WORKER)), "image": packed(image)}})


def _with_parts(page: str, others: Mapping[str, Any]) -> str:
    common = {"programs": programs(), "debugger": as_called("tools/octet debug"), "atlas": mean_times()}
    parts = {"worlds": world_dimensions(), **common, **others}
    if "why" not in parts:
        parts |= {"wasm": packed(_wasm()), "worker": script(_WORKER)}
    return with_data(with_data(page, "parts", parts), "speakers", _speakers())


@cache
def _speakers() -> str:
    return packed(as_script(speakers()))


def speakers() -> dict[str, Any]:
    """The speakers by name: `script` from `host_sim.talk.script`, and `texts` from `host_sim.talk.texts`."""
    return {name: {"script": script_named(name), "texts": texts_of(name)} for name in SPEAKERS}


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


def mean_times() -> list[int]:
    """The mean time of an environment for each memory, s, in the order of docs/tables/atlas-map.csv."""
    with (ROOT / "docs" / "tables" / "atlas-map.csv").open(newline="", encoding="utf-8") as file:
        return [round(float(row["mean_s"])) for row in csv.DictReader(file)]


def programs() -> dict[str, str]:
    """The sample programs by name."""
    files = sorted((PACKAGE / "program" / "examples").glob("*.bas"))
    return {path.stem: path.read_text(encoding="utf-8") for path in files}
