"""Commands robots between two ticks, as people at a page request."""

from host_sim.client.commands import erase_memory, freeze, write_cells
from host_sim.client.pacing import RealTime
from host_sim.live.page_commands import EraseMemory, Freeze, WriteCell
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.simulation import Simulation
from host_sim.world.edits import EditError

_DISCARDED_MAX = 256


def command_robot(simulation: Simulation, recorder: RunRecorder, command: WriteCell | EraseMemory | Freeze) -> None:
    """Sends a robot a command over the bus, as with a real robot.

    Raises:
        EditError: There is no such robot.
        RefusedError: The robot refuses the command.
        RobotError: The robot does not answer.
    """
    index = index_of(simulation, command.node)
    client = simulation.clients[index]
    simulation.set_clock()
    match command:
        case WriteCell(cell, side):
            write_cells(client, {cell: side})
        case EraseMemory():
            erase_memory(client)
        case Freeze(on):
            freeze(client, on)
            recorder.histories[index].frozen = on
    recorder.between(index, None, [client.memory])


def discard_reports(simulation: Simulation) -> None:
    """Discards what robots report between two ticks: they receive nothing, and say so.

    Takes a limited number of frames, so that a page does not wait for a line that never falls silent.
    """
    if isinstance(simulation.pace, RealTime):
        simulation.pace.rest()
    for client in simulation.clients:
        for _ in range(_DISCARDED_MAX):
            if client.connection.link.receive(0.0) is None:
                break
        client.connection.status()


def index_of(simulation: Simulation, node: int | None) -> int:
    """The index of the robot with a node number; None stands for the first.

    Raises:
        EditError: There is no such robot.
    """
    if node is None:
        return 0
    nodes = simulation.nodes
    if node not in nodes:
        raise EditError(f"there is no robot {node}; there are {', '.join(map(str, nodes))}")
    return nodes.index(node)
