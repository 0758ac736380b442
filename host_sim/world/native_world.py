"""Control ticks of an arena in C (`native/`), on the space that pymunk built, with the same results bit for bit."""

from struct import Struct
from typing import Any

from host_sim.paths import ROOT
from host_sim.world.arena import Arena
from host_sim.world.body import Body
from host_sim.world.munk_pointers import munk_pointers, own_pointer
from host_sim.world.params import SimParams
from host_sim.world.shapes import DISC, OBSTACLE

_NATIVE = ROOT / "host_sim" / "world" / "native"
_STATE = Struct("=8d9iB?")
HEADERS = (_NATIVE / "munk.h", _NATIVE / "world.h")


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
            library: Has the functions of `world.h`.
            arena: The arena.
            params: The dimensions of the world.

        Raises:
            NoNativeError: This pymunk's functions cannot be called from C.
        """
        self.arena, self._ffi, self._library = arena, ffi, library
        bodies, food = len(arena.bodies), len(arena.food.at)
        # cffi frees what no name holds any more.
        self._munk = munk_pointers(ffi)
        self._bodies: Any = ffi.new("struct body[]", bodies)
        self._food: Any = ffi.new("struct food[]", food)
        self._cones = ffi.new("struct cone[]", bodies * library.WORLD_CONES)
        self._loans = ffi.new("struct loan[]", library.WORLD_LOANS + bodies * library.WORLD_LOANS_EACH)
        self.world: Any = ffi.new("struct world *")
        self.world.munk, self.world.space = self._munk, own_pointer(ffi, "struct munk_space *", arena.space, "_space")
        self.world.params = {name: getattr(params, name) for name, _ in ffi.typeof("struct world_params").fields}
        self.world.obstacle_type, self.world.disc_type = OBSTACLE, DISC
        self.world.body_count, self.world.food_count = bodies, food
        self.world.bodies, self.world.food = self._bodies, self._food
        self.world.cones, self.world.loans = self._cones, self._loans
        for there, body in zip(self._bodies, arena.bodies, strict=True):
            self._bind(there, body)
        self._states = [ffi.buffer(ffi.addressof(there), _STATE.size) for there in self._bodies]

    def borrow(self) -> None:
        """Takes the arena over, as it is now."""
        for there, body in zip(self._states, self.arena.bodies, strict=True):
            _STATE.pack_into(there, 0, *body.state)
        food = self.arena.food
        for food_id, (there, (x, y)) in enumerate(zip(self._food, food.at, strict=True)):
            there.x_mm, there.y_mm, there.eaten = x, y, food_id not in food.uneaten
        self._library.world_borrow(self.world)

    def give_back(self) -> None:
        """Brings the arena up to date and leaves it to pymunk."""
        self._library.world_return(self.world)
        for there, body in zip(self._states, self.arena.bodies, strict=True):
            body.state = _STATE.unpack_from(there)
        food = self.arena.food
        for food_id in list(food.uneaten):
            if self._food[food_id].eaten:
                food.eat(food_id)

    def _bind(self, there: Any, body: Body) -> None:
        """Fills in what never changes in a body."""
        there.in_space = own_pointer(self._ffi, "struct munk_body *", body.in_space, "_body")
        there.disc = own_pointer(self._ffi, "struct munk_shape *", body.disc, "_shape")
        there.in_the_air, there.sight, there.first_cone = body.in_the_air, tuple(body.sight), body.first_cone
