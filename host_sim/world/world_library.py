"""The world in C: loads libraries that are built on it, and has its own."""

import hashlib
import os
import re
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from struct import Struct
from typing import Any

from host_sim.base.c_interface import c_interface
from host_sim.base.errors import OctetError
from host_sim.base.paths import BUILD, PACKAGE, ROOT

_CODES = {"double": "d", "uint8_t": "B", "uint16_t": "H", "_Bool": "?"}


class NoNativeError(OctetError):
    """The C code cannot be used."""

    def __init__(self, why: str) -> None:
        """Takes the reason."""
        super().__init__(f"{why}; build it with tools/setup")


def load_native(library: Path, prefix: str, headers: Sequence[Path], words: Path | None = None) -> tuple[Any, Any]:
    """A library, and the interface to it as its headers declare it.

    Args:
        library: The library.
        prefix: What the names of its functions begin with; `PREFIXstamp` gives the digests of the headers that it was
            built from.
        headers: Its headers, those that include others after them. cffi reads everything but preprocessor lines.
        words: A header that is generated with the library, and that the others need.

    Raises:
        NoNativeError: The library is missing, or was built from other headers.
    """
    if not library.exists():
        raise NoNativeError(f"{library.name} is missing")
    declared = map(declarations, headers if words is None else (words, *headers))
    ffi = c_interface("\n".join((f"const char *{prefix}stamp(void);", *declared)))
    try:
        loaded = ffi.dlopen(os.fspath(library))
        stamp: Any = ffi.string(getattr(loaded, f"{prefix}stamp")())
    except (OSError, AttributeError) as error:
        raise NoNativeError(f"{library.name} cannot be loaded ({error})") from None
    if stamp.decode() != "".join(hashlib.sha256(header.read_bytes()).hexdigest() for header in headers):
        raise NoNativeError(f"{library.name} was built from other sources")
    return ffi, loaded


def members(ffi: Any, kind: str, names: Sequence[str]) -> Struct:
    """Reads some members of a C struct, given in its order, from wherever its header has them."""
    layout, end = "=", 0
    for name, member in ffi.typeof(kind).fields:
        if name in names:
            layout += f"{member.offset - end}x{_CODES[member.type.cname]}"
            end = member.offset + ffi.sizeof(member.type)
    return Struct(layout)


def declarations(header: Path) -> str:
    """What a header declares, as cffi reads it: without comments and the preprocessor's lines."""
    text = re.sub(r"/\*.*?\*/", " ", header.read_text(encoding="utf-8"), flags=re.DOTALL)
    return re.sub(r"^#(.*\\\n)*.*$", "", text, flags=re.MULTILINE)


LIBRARY = BUILD / "host" / "host_sim" / "world" / "native" / "liboctet_world.so"
_NATIVE = PACKAGE / "world" / "native"
_WORDS = BUILD / "host" / "generated" / "robot_words.h"
WORLD_HEADERS = tuple(
    _NATIVE / f"{name}.h"
    for name in ("vector", "space/space", "body_faults", "world", "space/capsule", "space/plain_space")
)
_DRAW = tuple(_NATIVE / "draw" / f"{name}.h" for name in ("draws", "layout", "tour", "written"))
HEADERS = (
    *(ROOT / "firmware" / name for name in ("io.h", "memory/memory.h", "motion/speed_control.h")),
    *WORLD_HEADERS,
    _NATIVE / "ranges.h",
    *_DRAW,
    *(_NATIVE / f"{name}.h" for name in ("edits", "history", "kit/kit")),
)


@cache
def world_library() -> tuple[Any, Any]:
    """The interface to the library of the world, and the library.

    Raises:
        NoNativeError: It cannot be used.
    """
    return load_native(LIBRARY, "world_", HEADERS, words=_WORDS)
