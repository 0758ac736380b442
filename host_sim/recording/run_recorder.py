"""Takes a run down as it goes."""

from host_sim.recording.trajectory import Trajectory
from host_sim.sim.simulation import Simulation
from host_sim.view.history import LearningHistory
from host_sim.view.state import environment_scene
from host_sim.world.arena import Arena


class RunRecorder:
    """Called after each tick, makes the trajectory of a simulation.

    Attributes:
        history: Told tick by tick.
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
        self.history = LearningHistory(simulation.session.memory)
        self.trajectory = Trajectory(simulation.params, boredom_limit)

    def __call__(self, _number: int, arena: Arena) -> None:
        """Takes down the tick that has just ended."""
        simulation = self._simulation
        record, tick = simulation.record, simulation.tick - 1
        if (layouts := len(record.begun) + len(record.edits)) != self._layouts:
            self._layouts = layouts
            self.trajectory.enter(environment_scene(record.begun[-1], record.environments, arena))
        self.history.take(tick, simulation.senses, simulation.drive, simulation.session.memory)
        self.trajectory.add(arena, simulation.senses, simulation.drive, self.history)
