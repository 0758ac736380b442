"""Control ticks of an arena in C (`native/`), with the same results bit for bit."""

from struct import Struct
from typing import Any

from host_sim.paths import ROOT
from host_sim.world.arena import Arena
from host_sim.world.params import SimParams
from host_sim.world.plain_space import PlainSpace

_NATIVE = ROOT / "host_sim" / "world" / "native"
_STATE = Struct("=8d9iB?")
_NAMES = ("vector", "space", "world", "capsule", "cones", "plain_space", "body_faults")
HEADERS = tuple(_NATIVE / f"{name}.h" for name in _NAMES)


class NativeWorld:
    """The C counterpart of an arena: it borrows the arena for some ticks, and gives it back as it is after them.

    Attributes:
        arena: The arena. From `borrow` to `give_back` it must be left alone.
        world: Its counterpart, a `struct world *`.
    """

    def __init__(self, ffi: Any, library: Any, arena: Arena, params: SimParams) -> None:
        """Makes room for the state.

        Args:
            ffi: Has the declarations of `HEADERS`.
            library: Has their functions.
            arena: The arena.
            params: The dimensions of the world.
        """
        self.arena, self._ffi, self._library = arena, ffi, library
        self._space = PlainSpace(ffi, library, arena, params)
        bodies, food = len(arena.bodies), len(arena.food.at)
        # cffi frees what no name holds any more.
        self._bodies: Any = ffi.new("struct body[]", bodies)
        self._food: Any = ffi.new("struct food[]", food)
        self.world: Any = ffi.new("struct world *")
        self.world.params = {name: getattr(params, name) for name, _ in ffi.typeof("struct world_params").fields}
        self.world.body_count, self.world.food_count = bodies, food
        self.world.bodies, self.world.food = self._bodies, self._food
        self._states = [ffi.buffer(ffi.addressof(there), _STATE.size) for there in self._bodies]

    def borrow(self) -> None:
        """Takes the arena over, as it is now."""
        self.read_bodies()
        food = self.arena.food
        for food_id, (there, (x, y)) in enumerate(zip(self._food, food.at, strict=True)):
            there.x_mm, there.y_mm, there.eaten = x, y, food_id not in food.uneaten
        self._library.world_begin(self.world)
        self._space.take(self.world)

    def read_bodies(self) -> None:
        """Takes over where the arena's bodies are."""
        for there, body in zip(self._states, self.arena.bodies, strict=True):
            _STATE.pack_into(there, 0, *body.state)

    def give_back(self) -> None:
        """Brings the arena up to date and leaves it to pymunk."""
        self._space.give_back()
        for there, body in zip(self._states, self.arena.bodies, strict=True):
            body.state = _STATE.unpack_from(there)
        food = self.arena.food
        for food_id in list(food.uneaten):
            if self._food[food_id].eaten:
                food.eat(food_id)
