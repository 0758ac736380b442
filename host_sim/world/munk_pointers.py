"""The functions of pymunk's own build of Munk2D, for C code that steps a space which pymunk built."""

import importlib
from typing import Any

import pymunk

from host_sim.world.native_library import NoNativeError

# Each function with its type as pymunk declares it: if one differs, so may what lies behind the pointer.
_TYPES = {
    "cpSpaceStep": "void(*)(struct cpSpace *, double)",
    "cpSpaceAddCollisionHandler": "struct cpCollisionHandler *(*)(struct cpSpace *, uintptr_t, uintptr_t)",
    "cpSpaceSegmentQueryFirst": "struct cpShape *(*)(struct cpSpace *, struct cpVect, struct cpVect, double, "
    "struct cpShapeFilter, struct cpSegmentQueryInfo *)",
    "cpSpacePointQueryNearest": "struct cpShape *(*)(struct cpSpace *, struct cpVect, double, struct cpShapeFilter, "
    "struct cpPointQueryInfo *)",
    "cpBodySetPosition": "void(*)(struct cpBody *, struct cpVect)",
    "cpBodySetAngle": "void(*)(struct cpBody *, double)",
    "cpArbiterGetShapes": "void(*)(struct cpArbiter *, struct cpShape * *, struct cpShape * *)",
    "cpArbiterGetContactPointSet": "struct cpContactPointSet(*)(struct cpArbiter *)",
}
_LAYOUTS = {
    "struct cpVect": "struct munk_vector",
    "struct cpShapeFilter": "struct munk_filter",
    "struct cpContactPointSet": "struct munk_contacts",
    "struct cpSegmentQueryInfo": "struct munk_hit",
    "struct cpPointQueryInfo": "struct munk_nearest",
    "struct cpCollisionHandler": "struct munk_handler",
}


def munk_pointers(ffi: Any) -> Any:
    """A `struct munk` with pymunk's functions.

    Args:
        ffi: Has the declarations of `native/munk.h`.

    Raises:
        NoNativeError: This pymunk does not hand them out, or has others.
    """
    module = _cffi_module()
    for name, own in _LAYOUTS.items():
        if _layout(module.ffi, name) != _layout(ffi, own):
            raise NoNativeError(f"pymunk {pymunk.version} has another {name}")
    munk: Any = ffi.new("struct munk *")
    for name, expected in _TYPES.items():
        pointer = _pointer(module, name)
        if pointer is None or module.ffi.typeof(pointer).cname != expected:
            raise NoNativeError(f"pymunk {pymunk.version} has no such {name}")
        setattr(munk, name, ffi.cast(ffi.typeof(getattr(munk, name)), _address(module, pointer)))
    return munk


def own_pointer(ffi: Any, kind: str, thing: Any, name: str) -> Any:
    """The pointer to Munk2D's object in one of pymunk's.

    Args:
        ffi: Has the declarations of `native/munk.h`.
        kind: The pointer's type, such as "struct munk_space *".
        thing: pymunk's object.
        name: The attribute in which pymunk keeps the pointer, such as "_space".

    Raises:
        NoNativeError: This pymunk has no such attribute.
    """
    pointer = getattr(thing, name, None)
    if pointer is None:
        raise NoNativeError(f"pymunk {pymunk.version} has no {type(thing).__name__}.{name}")
    return ffi.cast(kind, _address(_cffi_module(), pointer))


def _cffi_module() -> Any:
    """The module of pymunk that has `ffi` and `lib`."""
    try:
        return importlib.import_module("pymunk._chipmunk_cffi")
    except ImportError:
        raise NoNativeError(f"pymunk {pymunk.version} hands out no pointers") from None


def _address(module: Any, pointer: Any) -> int:
    return int(module.ffi.cast("uintptr_t", pointer))


def _pointer(module: Any, name: str) -> Any | None:
    try:
        return module.ffi.addressof(module.lib, name)
    except AttributeError:
        return None


def _layout(ffi: Any, name: str) -> list[tuple[int, int]] | None:
    """Offset and size of each member of a struct, in order; None if there is no such struct."""
    try:
        return [(field.offset, ffi.sizeof(field.type)) for _, field in ffi.typeof(name).fields]
    except ffi.error:
        return None
