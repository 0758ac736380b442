"""Recorded runs of the real firmware, in this process, with the trajectory that was kept meanwhile."""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog, line_of
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import PARAMETERS
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.trajectory import Trajectory
from host_sim.recording.world_file import world_path, write_world
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation

Meddle = Callable[[Simulation, RunRecorder], None]


@dataclass(frozen=True)
class Kept:
    """A run's log, with its world file beside it, and what was seen of it as it went."""

    log: Path
    trajectory: Trajectory


def record_run(
    folder: Path,
    seed: int = 1,
    environments: int = 1,
    limit_s: float = 600.0,
    meddle: Meddle | None = None,
    **options,
) -> Kept:
    """Does a run with these and other options; `meddle` is called before each tick."""
    folder.mkdir(exist_ok=True)
    log = folder / "run.log"
    with ExitStack() as stack:
        config = RunConfig(seed=seed, environments=environments, limit_s=limit_s, **options)
        simulation = open_simulation(stack, log, config)
        recorder = run_through(simulation, meddle)
        stop(simulation.clients[0])
    write_world(simulation.record, world_path(log))
    return Kept(log, recorder.trajectory)


def run_through(simulation: Simulation, meddle: Meddle | None = None) -> RunRecorder:
    """Runs a simulation to its end; `meddle` is called before each tick."""
    recorder = RunRecorder.of(simulation, PARAMETERS["boredom_limit"].default)
    for number in range(1, simulation.environments + 1):
        simulation.enter(number)
        while not simulation.over:
            if meddle is None:
                simulation.step(simulation.block_ticks)
            else:
                meddle(simulation, recorder)
                simulation.step()
        simulation.leave()
    return recorder


def open_simulation(stack: ExitStack, log: Path, config: RunConfig) -> Simulation:
    """Started robots in a simulation that has not begun; the log is whole when the stack has closed."""
    frames = FrameLog(log)
    stack.callback(frames.close)
    return stack.enter_context(make(config, frames))


def write_log(path: Path, *frames: Frame) -> Path:
    """Writes a log of frames, each 20 ms after the one before."""
    path.write_text("".join(f"{line_of(20_000 * i, frame)}\n" for i, frame in enumerate(frames)))
    return path


def without(log: Path, name: str, **signals: int) -> None:
    """Removes from a log the messages of that name with these signals."""
    protocol = Protocol()

    def stays(line: str) -> bool:
        frame_id, data = line.split()[2].split("#")
        decoded = protocol.decode(Frame(int(frame_id, 16), bytes.fromhex(data)))
        return decoded is None or decoded.name != name or not signals.items() <= decoded.signals.items()

    log.write_text("".join(filter(stays, log.read_text().splitlines(keepends=True))))
