"""Takes a run down as it goes."""

from host_sim.kept.story import Story
from host_sim.kept.trajectory import Trajectory
from host_sim.live.scene import environment_scene
from host_sim.world.arena import Arena
from host_sim.world.simulation import Simulation


class Keeper:
    """Called after each tick, makes the trajectory of a simulation.

    Attributes:
        story: Told tick by tick.
        trajectory: What was taken down so far.
    """

    def __init__(self, simulation: Simulation, boredom_limit: int = 10) -> None:
        """Waits for the first tick.

        Args:
            simulation: Has not begun yet.
            boredom_limit: The remembered turn in a row after which the robot is bored.
        """
        self._simulation = simulation
        self._layouts = 0
        self.story = Story(simulation.session.memory)
        self.trajectory = Trajectory(simulation.world, boredom_limit)

    def __call__(self, _number: int, arena: Arena) -> None:
        """Takes down the tick that has just ended."""
        simulation = self._simulation
        record, tick = simulation.record, simulation.tick - 1
        if (layouts := len(record.begun) + len(record.edits)) != self._layouts:
            self._layouts = layouts
            self.trajectory.enter(environment_scene(record.begun[-1], record.environments, arena))
        self.story.take(tick, simulation.senses, simulation.drive, simulation.session.memory)
        self.trajectory.add(arena, simulation.senses, simulation.drive, self.story)
