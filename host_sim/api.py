"""For programs of your own: runs and logs without the command line. docs/python.md shows how.

>>> from host_sim.api import RunConfig, run
>>> done = run(RunConfig(seed=1, environments=1, limit_s=20))
>>> [(episode.robot_s, sum(episode.eaten)) for episode in done.episodes]
[(20.0, 0)]
>>> done.ticks()["x"].shape
(1000,)
"""

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from host_sim.base.errors import OctetError, RobotError, UsageError
from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.protocol.generated import ROW
from host_sim.recording.frame_table import arrow_table
from host_sim.recording.log_reader import read_log
from host_sim.recording.resimulation import resimulate
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.trajectory import Trajectory
from host_sim.recording.world_file import world_path, write_world
from host_sim.report.replay_page import write_page
from host_sim.sim.make import Memory, make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.sim.world_record import EpisodeResult

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "EpisodeResult",
    "OctetError",
    "RobotError",
    "Run",
    "RunConfig",
    "Simulation",
    "Trajectory",
    "UsageError",
    "log_table",
    "make",
    "resimulate",
    "run",
    "ticks_of",
    "write_page",
    "write_picture",
]


@dataclass(frozen=True)
class Run:
    """A run that has ended.

    Attributes:
        episodes: The result of each environment.
        trajectory: The data for pictures and pages; of a very long run, only its last environments.
        memories: Each robot's eight cells at the end.
        log_sha256: SHA-256 of the log without the data of BOOT, in hexadecimal: equal for equal frames, in any build.
    """

    episodes: list[EpisodeResult]
    trajectory: Trajectory
    memories: list[tuple[int, ...]]
    log_sha256: str

    def ticks(self, robot: int = 0) -> "dict[str, NDArray[Any]]":
        """As `ticks_of`."""
        return ticks_of(self.trajectory, robot)


def run(
    config: RunConfig | None = None,
    log: Path | str | None = None,
    memories: Sequence[Memory | None] = (),
    each: Callable[[EpisodeResult], object] = lambda _: None,
) -> Run:
    """Runs robots through all environments.

    Args:
        config: The run; by default, that of a command line without options, with the robot in this process.
        log: File for every frame, with the world file beside it; None for no file. A run that ends early leaves both
            as far as it came; one that cannot begin leaves those of an earlier run.
        memories: For each robot, the eight cells to begin with; None, or no entry, for an empty memory.
        each: Called with the result of each environment.

    Raises:
        UsageError: The configuration is invalid, or the log cannot be written.
        OctetError: Something that must be built or installed is missing.
        RobotError: A robot does not answer.
    """
    config = config or RunConfig()
    path = None if log is None else Path(log)
    with ExitStack() as stack:
        frames = FrameLog(path)
        stack.callback(frames.drop)  # where no run has begun
        simulation = stack.enter_context(make(config, frames, memories))
        recorder = RunRecorder.of(simulation, config.boredom_limit)
        episodes = []
        try:
            for episode in simulation.run():
                episodes.append(episode)
                each(episode)
            for client in simulation.clients:
                stop(client)
        finally:
            digest = frames.close()
            if path is not None:
                write_world(simulation.record, world_path(path))
        cells = [client.memory for client in simulation.clients]
    return Run(episodes, recorder.trajectory, cells, digest)


def ticks_of(trajectory: Trajectory, robot: int = 0) -> "dict[str, NDArray[Any]]":
    """A robot's ticks as columns of equal length, as pandas and Arrow take them.

    The columns are `tick_number`, counted from the start of the run; `x` and `y` in mm and `heading` in rad, after
    the tick; and the fields of `Senses` and `Drive`, the pattern, and whether the robot was lifted or frozen.

    Args:
        trajectory: The run.
        robot: Index of the robot.
    """
    import numpy as np  # noqa: PLC0415 - nothing else here needs it

    track = trajectory.tracks[robot]
    x, y, heading = track.poses().T
    number = np.arange(trajectory.first_tick, trajectory.ticks)
    rows = {name: np.array(track.column(name)) for name in ROW}
    return {"tick_number": number, "x": x.copy(), "y": y.copy(), "heading": heading.copy(), **rows}


def write_picture(path: Path, trajectory: Trajectory) -> None:
    """As `host_sim.report.picture.write_picture`, which needs Pillow."""
    from host_sim.report import picture  # noqa: PLC0415 - nothing else here needs it

    picture.write_picture(path, trajectory)


def log_table(log: Path | str) -> Any:
    """A log as a `pyarrow.Table`, a row for each frame; `to_pandas()` of it gives a data frame.

    Args:
        log: A log of a run, of candump or of python-can.

    Raises:
        UsageError: The log cannot be read, or pyarrow is not installed: `tools/setup export` does that.
        OctetError: The log is damaged.
    """
    return arrow_table(read_log(Path(log)))
