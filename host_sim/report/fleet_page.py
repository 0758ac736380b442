"""`fleet.html`: the robots of a fleet on the move, to play and scrub, in one page without a server.

The page's element `fleet` has one object, with lengths in mm and headings in mrad:

    title        a line for people
    robots       their number
    own          whether each is in a world of its own
    width height inside dimensions of a world
    body         radius of a robot
    bar          thickness of an obstacle
    sample_s     robot time from one sample to the next
    samples      their number, from the start on
    bars food    of the first environment, if all share one: [ax, ay, bx, by] and [x, y]
    columns      the names of the columns: x, y and heading of each robot, one number for each sample
    data         the columns, packed as those of a replay
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from host_sim.base.atomic_file import write_bytes
from host_sim.report.page_bundle import page_of, with_data
from host_sim.report.replay_page import pack
from host_sim.sim.fleet import SAMPLE_TICKS
from host_sim.sim.run_config import RunConfig
from host_sim.world.layouts import Layout
from host_sim.world.params import SimParams
from host_sim.world.worlds import world_of

_AXES = ("x", "y", "heading")


def write_fleet_page(
    path: Path, config: RunConfig, samples: Sequence[NDArray[np.int64]], shared: tuple[Layout, SimParams] | None
) -> None:
    """Writes the page of a fleet; equal runs give equal bytes.

    Args:
        path: The file to write; an existing one is replaced.
        config: The run.
        samples: The positions of all robots, each of shape (robots, 3).
        shared: For robots that share a world: its first environment, and its dimensions.

    Raises:
        OctetError: The file cannot be written.
    """
    params = world_of(config.world).params if shared is None else shared[1]
    fleet = {
        "title": f"{config.robots} robots, profile {config.profile}, seed {config.seed}",
        "robots": config.robots,
        "own": shared is None,
        "width": params.width_mm,
        "height": params.height_mm,
        "body": params.body_radius_mm,
        "bar": params.bar_thickness_mm,
        "sample_s": SAMPLE_TICKS * params.tick_s,
        "samples": len(samples),
        **_things(None if shared is None else shared[0]),
        **_columns(np.stack(samples)),
    }
    write_bytes(path, with_data(page_of("fleet.html"), "fleet", fleet).encode())


def _things(layout: Layout | None) -> dict[str, Any]:
    if layout is None:
        return {"bars": [], "food": []}
    return {"bars": [[*a, *b] for a, b in layout.bars], "food": [list(at) for at in layout.food]}


def _columns(positions: NDArray[np.int64]) -> dict[str, Any]:
    """The columns of positions of shape (samples, robots, 3)."""
    places = [(robot, axis) for robot in range(positions.shape[1]) for axis in range(len(_AXES))]
    names = [f"{_AXES[axis]}{robot}" for robot, axis in places]
    return {"columns": names, "data": pack(positions[:, robot, axis].tolist() for robot, axis in places)}
