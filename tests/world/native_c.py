"""An arena that senses, eats and moves in C, one call at a time, for tests."""

from functools import cache
from pathlib import Path

import cffi

from host_sim.robot_io import Senses
from host_sim.world.arena import Arena
from host_sim.world.native_library import declarations
from host_sim.world.native_reach import LIBRARY
from host_sim.world.native_world import HEADERS, NativeWorld
from host_sim.world.params import SimParams

ROOT = Path(__file__).resolve().parents[2]
_WORDS = ROOT / "build/host/generated/robot_words.h"


@cache
def load() -> tuple[cffi.FFI, object]:
    """The library, with the declarations of what the robot senses."""
    ffi = cffi.FFI()
    for header in (_WORDS, ROOT / "firmware/io.h", *HEADERS):
        ffi.cdef(declarations(header))
    return ffi, ffi.dlopen(str(LIBRARY))


class CArena:
    """The interface of `Arena` and of its bodies, in C."""

    def __init__(self, arena: Arena, params: SimParams) -> None:
        self.ffi, self.library = load()
        self.arena = arena
        self.native = NativeWorld(self.ffi, self.library, arena, params)
        self.out = self.ffi.new("struct senses *")
        self.native.borrow()

    def _body(self, index: int) -> object:
        return self.ffi.addressof(self.native.world.bodies[index])

    def sense(self, index: int, tick: int) -> Senses:
        self.library.world_sense(self.native.world, self._body(index), tick, self.out)
        return Senses(*(int(getattr(self.out, name)) for name in Senses._fields))

    def eat(self, index: int) -> bool:
        return bool(self.library.world_eat(self.native.world, self._body(index)))

    def move(self, index: int, left_mm_s: int, right_mm_s: int) -> None:
        self.library.world_move(self.native.world, self._body(index), left_mm_s, right_mm_s)
