"""A board by its name."""

from host_sim.backends.images import image_path
from host_sim.emulator.board import EmulatedBoard
from host_sim.emulator.chips import CHIPS
from host_sim.emulator.hardware import Faults
from host_sim.errors import UsageError


def start_board(name: str, faults: Faults | None = None, link: str = "bxcan") -> EmulatedBoard:
    """A board with the image that the build leaves for it, up and running.

    Args:
        name: `stm32f405` or `stm32f103`.
        faults: How its hardware misbehaves.
        link: `bxcan` or `slcan`: which of its images.

    Raises:
        UsageError: There is no such board.
        OctetError: Its image is not built.
        BoardError: The image does what the hardware does not allow.
    """
    if name not in CHIPS:
        raise UsageError(f"no board {name!r}; there are {', '.join(CHIPS)}")
    return EmulatedBoard(CHIPS[name], image_path(name, link), faults, serial=link == "slcan")
