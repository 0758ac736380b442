"""A run of so many ticks, for comparing and measuring robots."""

from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation


def run_ticks(config: RunConfig, ticks: int, log: FrameLog) -> RobotClient:
    """Lets a robot learn, one environment after the other, until that many ticks have passed.

    Args:
        config: What to run; its number of environments does not count.
        ticks: How many.
        log: Gets the frames; it is closed.

    Returns:
        The robot's client, as it was at the end.

    Raises:
        RobotError: The robot is gone.
    """
    try:
        with make(config, log) as simulation:
            step_through(simulation, ticks)
            return simulation.clients[0]
    finally:
        log.close()


def step_through(simulation: Simulation, ticks: int) -> None:
    """Steps through one environment after the other until that many ticks have passed, and stops the robot.

    Raises:
        RobotError: The robot is gone.
    """
    number = 0
    while simulation.tick < ticks:
        number += 1
        simulation.enter(number)
        while not simulation.over and simulation.tick < ticks:
            simulation.step()
        simulation.leave()
    simulation.set_clock()
    stop(simulation.clients[0])
