"""The models that are written in C (`models/`), declared by their own headers."""

from functools import cache
from typing import Any

from host_sim.base.c_interface import c_interface
from host_sim.base.errors import OctetError
from host_sim.base.paths import BUILD, PACKAGE, ROOT

LIBRARY = BUILD / "host" / "host_sim" / "emulator" / "models" / "liboctet_models.so"
_MODELS = PACKAGE / "emulator" / "models"
_NAMES = (
    "can_wire",
    "can_node",
    "bxcan_model",
    "fdcan_model",
    "board_clock",
    "core_blocks",
    "register_space",
)
_HEADERS = (ROOT / "hal" / "link" / "link.h", *(_MODELS / f"{name}.h" for name in _NAMES))


@cache
def c_models() -> tuple[Any, Any]:
    """The interface to the models, and their library.

    Raises:
        OctetError: The models are not built.
    """
    lines = [line for header in _HEADERS for line in header.read_text().splitlines() if not line.startswith("#")]
    ffi = c_interface("\n".join(lines))
    try:
        return ffi, ffi.dlopen(str(LIBRARY))
    except OSError as error:
        raise OctetError(f"cannot load the models of hardware: {error}; build them with tools/setup") from error
