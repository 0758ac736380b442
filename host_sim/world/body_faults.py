"""Faults of a body: in its sensors, its motors, or the wires between them and the robot."""

from importlib.util import find_spec
from typing import Any

from host_sim.base.near_word import meant
from host_sim.protocol.words import BODY_FAULTS
from host_sim.world.world_library import world_library


def check_fault(what: str) -> None:
    """Refuses text that does not name a fault.

    The plain python3 that checks a command line cannot call C, so it checks only the names.

    Raises:
        ValueError: There is no such fault; the message says what is expected.
    """
    name = what.partition(":")[0]
    if name not in BODY_FAULTS:
        raise ValueError(meant(name, BODY_FAULTS))
    if find_spec("_cffi_backend"):
        add_fault(world_library()[0].new("struct body_faults *"), what)


def add_fault(faults: Any, what: str, seed: int = 0, robot: int = 0) -> None:
    """Adds or repairs a fault of a body.

    Args:
        faults: Its `struct body_faults *`.
        what: The fault, such as "stuck-on:front"; docs/worlds.md has all.
        seed: Determines, with the robot, the ticks of noise.
        robot: Number of the robot, from 0.

    Raises:
        ValueError: There is no such fault.
    """
    ffi, library = world_library()
    if why := library.body_faults_add(faults, what.encode(), seed, robot):
        raise ValueError(ffi.string(why).decode())
