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
"""Folder of parsed declarations, cached as Python modules."""


@cache
def c_interface(declarations: str) -> Any:
    """Creates an interface to C code: a cffi `FFI` object, except that it takes no more declarations.

    >>> ffi = c_interface("struct point { int x, y; };")
    >>> ffi.new("struct point *", (3, 4)).y
    4

    Args:
        declarations: Declarations of the C code, as for `FFI.cdef`.
    """
    name = "octet_" + hashlib.sha256(declarations.encode()).hexdigest()[:16]
    path = FOLDER / f"{name}.py"
    with contextlib.suppress(Exception):  # missing, damaged, or written by an incompatible cffi
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
    """Writes the module. Concurrent processes are safe, since cffi renames it when complete."""
    path.parent.mkdir(parents=True, exist_ok=True)
    ffi = _read(declarations)
    ffi.set_source(path.stem, None)
    with contextlib.redirect_stdout(io.StringIO()):  # cffi prints what it writes
        ffi.emit_python_code(str(path))


def _load(path: Path) -> Any:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec and spec.loader  # noqa: PT018 - it ends in .py
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.ffi
