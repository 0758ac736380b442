"""What a robot is told to do: start, stop, and changes of its memory."""

from collections.abc import Mapping, Sequence

from host_sim.client.robot_client import RobotClient


def start(
    client: RobotClient, seed: int, profile: int, settings: Mapping[str, int], memory: Sequence[int] | None
) -> None:
    """Sets the robot going: it moves with the next senses.

    Args:
        client: The robot's.
        seed: 0..2**32 - 1, of its random turns.
        profile: Number of its profile.
        settings: Parameters to set, by name.
        memory: Eight cells to write first; None leaves the robot its own.

    Raises:
        RefusedError: It refuses something.
        RobotError: It does not answer.
    """
    client.command("start", profile=profile, seed=seed)
    for name, value in settings.items():
        client.command("set", parameter=client.protocol.choices("COMMAND", "parameter")[name], value=value)
    if memory is not None:
        write_cells(client, dict(enumerate(memory)))


def stop(client: RobotClient) -> None:
    """Brings the wheels to rest and takes the robot's last report.

    Raises:
        RobotError: It does not answer.
    """
    client.command("stop")
    client.expect("MEMORY", "stop")


def write_cells(client: RobotClient, sides: Mapping[int, int]) -> None:
    """Writes cells of the memory, and waits for the memory that this leaves.

    Args:
        client: The robot's.
        sides: For each cell to write, what it is to hold: 0 nothing, 1 left, 2 right.

    Raises:
        RefusedError: The robot refuses it.
        RobotError: It does not answer.
    """
    mask = sum(1 << cell for cell in sides)
    client.command("write", mask=mask, cells=sum(side << 2 * cell for cell, side in sides.items()))
    client.expect("MEMORY", "write")


def erase_memory(client: RobotClient) -> None:
    """Erases all cells, and waits for the memory that this leaves.

    Raises:
        RobotError: The robot does not answer.
    """
    client.command("erase")
    client.expect("MEMORY", "erase")


def freeze(client: RobotClient, on: bool) -> None:
    """Has the robot learn no more, or learn again.

    Raises:
        RobotError: It does not answer.
    """
    client.command("freeze", freeze=int(on))
