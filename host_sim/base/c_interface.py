"""Interfaces to C code, parsed from declarations. Parsing takes a third of a start, so results are cached."""

import contextlib
import hashlib
import importlib.util
import io
from functools import cache
from pathlib import Path
from typing import Any

from host_sim.base.paths import BUILD, INSTALLED

FOLDER = BUILD / "cffi"
"""What was read, as modules of Python."""


@cache
def c_interface(declarations: str) -> Any:
    """An interface to C code: all that an `FFI` object of cffi has, except that it takes no more declarations.

    >>> ffi = c_interface("struct point { int x, y; };")
    >>> ffi.new("struct point *", (3, 4)).y
    4

    Args:
        declarations: What the C code declares, as `FFI.cdef` reads it.
    """
    name = "octet_" + hashlib.sha256(declarations.encode()).hexdigest()[:16]
    path = FOLDER / f"{name}.py"
    with contextlib.suppress(Exception):  # nothing is there, or of a cffi that this one cannot read, or damaged
        return _load(path)
    if not INSTALLED:
        with contextlib.suppress(Exception):  # the folder is read-only, or the disk is full
            _write(path, declarations)
            return _load(path)
    return _read(declarations)


def _read(declarations: str) -> Any:
    import cffi  # noqa: PLC0415 - which takes time that a start seldom needs

    ffi: Any = cffi.FFI()
    ffi.cdef(declarations)
    return ffi


def _write(path: Path, declarations: str) -> None:
    """Writes the module. Processes may do so at once, for cffi renames it when it is complete."""
    path.parent.mkdir(parents=True, exist_ok=True)
    ffi = _read(declarations)
    ffi.set_source(path.stem, None)
    with contextlib.redirect_stdout(io.StringIO()):  # where cffi says that it writes
        ffi.emit_python_code(str(path))


def _load(path: Path) -> Any:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec and spec.loader  # noqa: PT018 - it ends in .py
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.ffi
