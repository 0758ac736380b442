"""The laboratory in the page of a recorded run: octet.html, and what the robots of the run were told.

The page's element `laboratory` has one object, with

    page         octet.html, packed
    run          the run: `commands`, each [tick, robot counted from 0, digits of a COMMAND frame]; `ticks`, their
                 number; `world`, the text of its world file, empty if there is none

or, if the run cannot be repeated, with `why`, a sentence for people.
"""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from host_sim.base.errors import OctetError
from host_sim.base.regular_file import read_bytes
from host_sim.protocol.codec import Protocol
from host_sim.recording.log_reader import LogReader, Recorded
from host_sim.recording.resimulation import Resimulation
from host_sim.recording.world_file import world_path
from host_sim.report.octet_page import octet_page
from host_sim.report.page_bundle import packed

ROBOTS_MAX = 4
"""Maximum number of robots in the laboratory: PAGE_ROBOTS_MAX in host_sim/web/native/page.h."""

_WORLD_MAX = 16_000_000


class NoLaboratoryError(OctetError):
    """A run that the laboratory cannot repeat."""


def laboratory(log: LogReader, run: Resimulation) -> dict[str, Any]:
    """What the page of a run needs to ask "What if?".

    Args:
        log: The run's log.
        run: What was reconstructed from it.

    Raises:
        NoLaboratoryError: The laboratory cannot repeat this run.
        OctetError: The WebAssembly is not built.
    """
    nodes = [track.node for track in run.trajectory.tracks]
    if run.record is None:
        raise NoLaboratoryError("What if? needs the world of the run, which is not known here.")
    if run.record.program is not None:
        raise NoLaboratoryError("What if? runs the firmware's own brain, and the brain of this run was a program.")
    if nodes != list(range(1, len(nodes) + 1)) or len(nodes) > ROBOTS_MAX:
        raise NoLaboratoryError(f"What if? knows robots of nodes 1 to {ROBOTS_MAX} only.")
    if run.trajectory.first_tick:
        raise NoLaboratoryError("What if? is for shorter runs: this page has the last part of one only.")
    recorded = {"commands": _commands(log, len(nodes)), "ticks": run.trajectory.ticks, "world": _world(log.path)}
    return {"page": packed(octet_page()), "run": recorded}


def _commands(log: Iterable[Recorded], robots: int) -> list[tuple[int, int, str]]:
    """Each command, with its robot and the tick before which it was sent."""
    robot_of = {Protocol(robot + 1).id_of("COMMAND"): robot for robot in range(robots)}
    senses, tick = Protocol(1).id_of("SENSES"), 0
    commands = []
    for line in log:
        tick += line.frame.id == senses
        robot = robot_of.get(line.frame.id)
        if robot is not None:
            commands.append((tick, robot, line.frame.data.hex()))
    return commands


def _world(log: Path) -> str:
    path = world_path(log)
    return read_bytes(path, _WORLD_MAX).decode() if path.exists() else ""
