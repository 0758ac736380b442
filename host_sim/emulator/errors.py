"""What an emulated board can trip over."""

from host_sim.errors import RobotError


class BoardError(RobotError):
    """The image did what the hardware does not allow, or what no model here knows; says where."""


class PowerCut(Exception):  # noqa: N818 - nothing is wrong with the board
    """The power has gone, as was asked for."""
