"""The links of cells: places of a robot, and the events possible there."""

from collections.abc import Collection
from contextlib import AbstractContextManager, nullcontext

from host_sim.base.errors import UsageError
from host_sim.lab.campaign.cell import PINS_LINK
from host_sim.lab.campaign.setup import Setup
from host_sim.sim.access import BOARDS
from host_sim.transport.rule import Event

LINKS = ("none", "fd", "external", "slcan", "vcan", *BOARDS, PINS_LINK)
"""In this process, on a socket pair, a custom robot on one, on a serial line, on vcan0, on a board, on its pins."""


def open_setup(link: str, command: str = "") -> AbstractContextManager[Setup]:
    """Sets up a robot; leaving the context ends it.

    Args:
        link: One of `LINKS`.
        command: The program of a custom robot.

    Raises:
        UsageError: There is no such link, or this machine does not have it.
        OctetError: Something that must be built or installed is missing.
    """
    if link == "none":
        return nullcontext(Setup())
    if link == "fd":
        from host_sim.lab.campaign.socket_pair_setup import SocketPair  # noqa: PLC0415 - each loads what it needs

        return nullcontext(SocketPair())
    if link == "external":
        from host_sim.lab.campaign.socket_pair_setup import OwnProgram  # noqa: PLC0415 - see above

        return nullcontext(OwnProgram(command))
    if link in ("slcan", "vcan"):
        from host_sim.lab.campaign.line_setups import serial_line, virtual_bus  # noqa: PLC0415 - see above

        return serial_line() if link == "slcan" else virtual_bus()
    if link in BOARDS:
        from host_sim.lab.campaign.board_setup import Board  # noqa: PLC0415 - see above

        return nullcontext(Board(link))
    if link == PINS_LINK:
        from host_sim.lab.campaign.pins_setup import PinsRobot  # noqa: PLC0415 - see above

        return nullcontext(PinsRobot("blue_pill"))
    raise UsageError(f"there is no link {link!r}; there are {', '.join(LINKS)}")


def check_events(possible: Collection[str], link: str, events: tuple[Event, ...]) -> None:
    """Checks that events are among the possible ones of a link.

    Raises:
        UsageError: An event is not possible.
    """
    for event in events:
        if event.name not in possible:
            raise UsageError(f"{event.name} cannot happen on {link}; what can: {', '.join(sorted(possible))}")
