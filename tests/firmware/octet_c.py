"""The robot's C core for tests, as the project's own headers declare it."""

import os
import re
from functools import cache
from pathlib import Path

import cffi

ROOT = Path(__file__).resolve().parents[2]
_HEADERS = [
    "firmware/io.h",
    "firmware/pattern.h",
    "firmware/config.h",
    "firmware/memory/memory.h",
    "firmware/random.h",
    "firmware/brain.h",
    "firmware/caution.h",
    "firmware/motion/odometry_backlog.h",
    "firmware/motion/motion.h",
    "firmware/perception.h",
    "firmware/sharing.h",
    "firmware/robot.h",
    "hal/link/link.h",
    "hal/protocol/e2e.h",
]


def library_path() -> Path:
    """The library of all functions: OCTET_LIBRARY, or that of the build for tests."""
    return Path(os.environ.get("OCTET_LIBRARY", ROOT / "build/host-vcan/tests/firmware/liboctet_core_open.so"))


GENERATED = library_path().parents[2] / "generated"
"""What the build made of octet.dbc and robot.toml."""


def declarations(header: Path) -> str:
    """What a header declares, without the preprocessor's lines, which cffi does not read."""
    text = header.read_text()
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.DOTALL)
    text = re.sub(r"^#(.*\\\n)*.*$", "", text, flags=re.MULTILINE)
    return re.sub(r'extern "C" \{|^\}$', "", text, flags=re.MULTILINE)


@cache
def load() -> tuple[cffi.FFI, object]:
    """The library and the interface to it, declared by the headers that it was built from."""
    ffi = cffi.FFI()
    for header in (GENERATED / "robot_words.h", *(ROOT / header for header in _HEADERS), GENERATED / "octet.h"):
        ffi.cdef(declarations(header))
    return ffi, ffi.dlopen(str(library_path()))
