"""`fleet.html`: the motion of a fleet's robots, with playback controls, in one page without a server.

The page's element `fleet` has one object, with lengths in mm and headings in mrad:

    profile      the robots' behaviour
    robots       their number
    own          whether each is in a world of its own
    width height inside dimensions of a world
    body         radius of a robot
    bar          thickness of an obstacle
    sample_s     robot time from one sample to the next
    samples      their number, from the start on
    seed         that of the first robot; each other one has the next number
    environments the number of environments of each robot
    alone        options with which a robot runs alone as it did here, but for its seed
    columns      the names of the columns, one number for each sample: x0, y0, heading0 and knows0 of the first robot,
                 the last as in `FleetFilm.sides`; eaten0.0 of the first world: a bit for each of 30 pieces of food
    data         the columns, packed as those of a replay
    scene_count  how many numbers `scenes` has
    scenes       the environments, packed as one column: the world, the sample from which on it is there, the number
                 of its obstacles and ax, ay, bx, by of each, the number of its pieces of food and x, y of each
"""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from host_sim.base.atomic_file import write_bytes
from host_sim.report.page_bundle import page_of, with_data
from host_sim.report.replay_page import pack
from host_sim.sim.fleet_film import SAMPLE_TICKS, FleetFilm
from host_sim.sim.run_config import RunConfig
from host_sim.world.params import SimParams

_AXES = ("x", "y", "heading")
_EATEN_BITS = 30


def write_fleet_page(path: Path, config: RunConfig, film: FleetFilm, params: SimParams) -> None:
    """Writes the page of a fleet from a film of at least one sample; equal runs give equal bytes.

    Raises:
        OctetError: The file cannot be written.
    """
    columns = dict(_columns(film))
    scenes = _scenes(film)
    fleet = {
        "profile": config.profile,
        "robots": config.robots,
        "own": config.worlds == "own",
        "width": params.width_mm,
        "height": params.height_mm,
        "body": params.body_radius_mm,
        "bar": params.bar_thickness_mm,
        "sample_s": SAMPLE_TICKS * params.tick_s,
        "samples": len(film.poses),
        "seed": config.seed,
        "environments": config.environments,
        "alone": _alone(config),
        "columns": list(columns),
        "data": pack(columns.values()),
        "scene_count": len(scenes),
        "scenes": pack([scenes]),
    }
    write_bytes(path, with_data(page_of("fleet.html"), "fleet", fleet).encode())


def _alone(config: RunConfig) -> str:
    words = [f"--{name} {getattr(config, name)}" for name in ("environments", "profile", "world", "body")]
    settings = (f"--set {name}={value}" for name, value in config.settings.items())
    return " ".join([*words, f"--limit-s {config.limit_s:.10g}", *settings])


def _columns(film: FleetFilm) -> Iterator[tuple[str, Sequence[int]]]:
    poses, sides = np.stack(film.poses), np.stack(film.sides)
    for robot in range(poses.shape[1]):
        for axis, name in enumerate(_AXES):
            yield f"{name}{robot}", poses[:, robot, axis].tolist()
        yield f"knows{robot}", sides[:, robot].tolist()
    for world in range(len(film.eaten[0])):
        eaten = [sum(1 << i for i, gone in enumerate(worlds[world]) if gone) for worlds in film.eaten]
        most = max(len(worlds[world]) for worlds in film.eaten)
        for part in range(-(-most // _EATEN_BITS)):
            yield f"eaten{world}.{part}", [bits >> part * _EATEN_BITS & (1 << _EATEN_BITS) - 1 for bits in eaten]


def _scenes(film: FleetFilm) -> list[int]:
    numbers: list[float] = []
    for world, sample, layout in film.scenes:
        numbers += (world, sample, len(layout.bars), *(number for a, b in layout.bars for number in (*a, *b)))
        numbers += (len(layout.food), *(number for at in layout.food for number in at))
    return [round(number) for number in numbers]
