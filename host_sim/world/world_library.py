"""The C code of the world (`native/`), for Python."""

from functools import cache
from typing import Any

from host_sim.base.paths import BUILD, PACKAGE, ROOT

LIBRARY = BUILD / "host" / "host_sim" / "world" / "native" / "liboctet_world.so"
_NATIVE = PACKAGE / "world" / "native"
_WORDS = BUILD / "host" / "generated" / "robot_words.h"
WORLD_HEADERS = tuple(
    _NATIVE / f"{name}.h"
    for name in ("vector", "space/space", "body_faults", "world", "space/capsule", "cones", "space/plain_space")
)
_DRAW = tuple(
    _NATIVE / "draw" / f"{name}.h" for name in ("reach", "tour", "layout", "layouts", "written_fault", "written")
)
HEADERS = (
    *(ROOT / "firmware" / name for name in ("io.h", "memory/memory.h", "memory/memory_kind.h")),
    ROOT / "hal" / "pins_body" / "wheel.h",
    *WORLD_HEADERS,
    *(_NATIVE / f"{name}.h" for name in ("body", "ranges", "draw/draws", "clearance")),
    *_DRAW,
    *(_NATIVE / f"{name}.h" for name in ("furniture", "edits", "history", "kit/kit")),
)


@cache
def world_library() -> tuple[Any, Any]:
    """The interface to it, and the library.

    Raises:
        NoNativeError: It cannot be used.
    """
    # A command line is judged by the plain python3, which has no cffi.
    from host_sim.world.native_library import load_native  # noqa: PLC0415 - see above

    return load_native(LIBRARY, "world_", HEADERS, words=_WORDS)
