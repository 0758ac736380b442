"""Commands to a robot: start, stop, and changes of its memory."""

from collections.abc import Mapping, Sequence

from host_sim.client.robot_client import RobotClient
from host_sim.protocol.generated import CELL_COUNT

_HALF = CELL_COUNT // 2


def start(
    client: RobotClient, seed: int, profile: int, settings: Mapping[str, int], memory: Sequence[int] | None
) -> None:
    """Starts the robot: it moves with the next senses.

    Args:
        client: The robot's client.
        seed: Seed for its random turns, 0..2**32 - 1.
        profile: Number of its profile.
        settings: Parameters to set, by name.
        memory: Eight cells to write; None leaves the robot's memory as it is.

    Raises:
        RefusedError: The robot refuses a command.
        RobotError: The robot does not answer.
    """
    client.command("start", profile=profile, seed=seed, lockstep=int(client.lockstep))
    for name, value in settings.items():
        client.command("set", parameter=client.protocol.choices("COMMAND", "parameter")[name], value=value)
    if memory is not None:
        write_cells(client, dict(enumerate(memory)))


def stop(client: RobotClient) -> None:
    """Stops the robot's wheels and receives its final reports.

    Raises:
        RobotError: The robot does not answer.
    """
    client.command("stop")
    client.await_rest("stop")


def write_cells(client: RobotClient, sides: Mapping[int, int]) -> None:
    """Writes cells of the memory and waits until the robot reports its new memory.

    Args:
        client: The robot's client.
        sides: New content by cell, 0..7: 0 nothing, 1 left, 2 right.

    Raises:
        RefusedError: The robot refuses the command.
        RobotError: The robot does not answer.
    """
    for half in range(2):
        cells = {cell % _HALF: side for cell, side in sides.items() if cell // _HALF == half}
        if cells:
            content = {f"byte_{i}": cells.get(i, 0) for i in range(_HALF)}
            client.command("write", mask=sum(1 << i for i in cells), half=half, **content)
            _await_memory(client, "write")


def erase_memory(client: RobotClient) -> None:
    """Erases all cells and waits until the robot reports its new memory.

    Raises:
        RobotError: The robot does not answer.
    """
    client.command("erase")
    _await_memory(client, "erase")


def freeze(client: RobotClient, on: bool) -> None:
    """Stops the robot's learning, or lets it learn again.

    Raises:
        RobotError: The robot does not answer.
    """
    client.command("freeze", freeze=int(on))


def _await_memory(client: RobotClient, after: str) -> None:
    """Waits for both halves of the memory."""
    while client.expect("MEMORY", after).signals["half"] == 0:
        pass
