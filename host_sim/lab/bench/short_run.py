"""Runs of a given number of ticks, for comparing and measuring robots."""

from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation


def run_ticks(config: RunConfig, ticks: int, log: FrameLog) -> RobotClient:
    """Runs a robot in one environment after the other for a number of ticks, and closes the log.

    Returns:
        The robot's client, at the end of the run.

    Raises:
        RobotError: The robot has ended or does not answer.
    """
    try:
        with make(config, log) as simulation:
            step_through(simulation, ticks)
            return simulation.clients[0]
    finally:
        log.close()


def step_through(simulation: Simulation, ticks: int) -> None:
    """Steps through one environment after the other, from the first, for a number of ticks, then stops the robot.

    Raises:
        RobotError: The robot has ended or does not answer.
    """
    number = 0
    while simulation.tick < ticks:
        number += 1
        simulation.enter(number)
        while not simulation.over and simulation.tick < ticks:
            simulation.step(ticks - simulation.tick)
        simulation.leave()
    simulation.set_clock()
    stop(simulation.clients[0])
