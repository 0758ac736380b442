"""The data with which a page repeats a recorded run, so that its future can be changed there.

One object, with

    recorded     `commands`, each [tick, robot counted from 0, digits of a COMMAND frame]; `ticks`, their number;
                 `world`, the text of its world file, empty if there is none

or, if the run cannot be repeated, with `why`, a sentence for people.
"""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from host_sim.base.files import read_bytes
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import PAGE_ROBOTS_MAX
from host_sim.recording.trajectory import Trajectory
from host_sim.recording.world_file import world_path
from host_sim.sim.world_record import WorldRecord

if TYPE_CHECKING:
    from host_sim.recording.log_reader import LogReader

_WORLD_MAX = 16_000_000

NO_FIRMWARE = {
    "why": "This page has no firmware; to add it: tools/octet replay out/run.log --html out/replay.html --what-if"
}
"""Why the page of a run repeats nothing if the firmware was not built for pages."""


def laboratory(
    world: str, trajectory: Trajectory, record: WorldRecord | None, commands: Iterable[tuple[int, Frame]]
) -> dict[str, Any]:
    """The data with which the page of a run answers "What if?", or the reason why it cannot.

    Args:
        world: The text of the run's world file; empty if there is none.
        trajectory: The run.
        record: Its world; None if unknown.
        commands: The commands in the order of their ticks, each with the number of ticks before it.
    """
    nodes = [track.node for track in trajectory.tracks]
    if record is None:
        return {"why": "What if? needs the world of the run, which is not known here."}
    if record.own:
        return {"why": f"What if? runs the firmware's own brain, and the brain of this run was {record.own}."}
    if record.world.crates is not None:
        return {"why": "What if? cannot repeat this run: pymunk moved its crates."}
    if nodes != list(range(1, len(nodes) + 1)) or len(nodes) > PAGE_ROBOTS_MAX:
        return {"why": f"What if? supports only robots of nodes 1 to {PAGE_ROBOTS_MAX}."}
    if trajectory.first_tick:
        return {"why": "What if? is for shorter runs: this page has only the last part of a longer one."}
    robot_of = {Protocol(robot + 1).id_of("COMMAND"): robot for robot in range(len(nodes))}
    told = [(tick, robot_of[frame.id], frame.data.hex()) for tick, frame in commands if frame.id in robot_of]
    return {"recorded": {"commands": told, "ticks": trajectory.ticks, "world": world}}


def commands_in(log: "LogReader") -> Iterator[tuple[int, Frame]]:
    """Yields every frame of a log, commands among them, each with the number of ticks before it."""
    senses, tick = Protocol(1).id_of("SENSES"), 0
    for line in log:
        tick += line.frame.id == senses
        yield tick, line.frame


def world_beside(log: Path) -> str:
    """The text of a log's world file; empty if there is none."""
    path = world_path(log)
    return read_bytes(path, _WORLD_MAX).decode() if path.exists() else ""
