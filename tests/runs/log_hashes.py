"""Prints the SHA-256 of the logs of some 200 short runs, to hold a change of the code to the same bytes.

    .venv/bin/python -m tests.runs.log_hashes > before.json
    .venv/bin/python -m tests.runs.log_hashes --against before.json

The runs cover worlds, behaviours, parameters, numbers of robots, changes, edits, faults, buses and fleets. What BOOT
says is left out, since it names the commit. With `--against`, it names each run whose hash differs; the exit code is
1 if there is one.
"""

import argparse
import hashlib
import json
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from host_sim.base.errors import RobotError
from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.protocol.generated import PROFILES
from host_sim.sim.fleet import run_fleet
from host_sim.sim.make import make
from host_sim.sim.native_loop import BLOCK_TICKS
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.world.edits import Edit, EditError
from host_sim.world.names import STILL_WORLDS

EDITS = {
    60: Edit("plant", at=(700.0, 600.0), radius=80.0),
    100: Edit("add_bar", a=(0.0, 0.0), b=(0.0, 900.0)),
    150: Edit("lift"),
    170: Edit("put", at=(1000.0, 1000.0), heading=1000),
    200: Edit("body", what="mirror"),
    210: Edit("grow_plant", 0, radius=200.0),
    250: Edit("move_bar", 0, a=(900.0, 900.0), b=(900.0, 1500.0)),
    300: Edit("move_food", 1, at=(50.0, 2950.0)),
    350: Edit("move_plant", 0, at=(1400.0, 1100.0)),
    400: Edit("remove_bar", 1),
    450: Edit("remove_plant", 0),
}
"""By the tick before which each of them is made, where it can be."""

CHANGES = (
    *("plant@1s", "plant:600,700@2s", "mirror@2s", "swap-motors@3s", "stuck-on:front@2s", "stuck-off:left@1s"),
    *("noise:100/1000@1s", "weak-motor:left:60%@1s", "swap-odometers@4s", "odometer:left:150%@1s"),
    *("odometer:right:-30%@5s", "odometer:left:-100%@2s", "odometer:right:0%@6s", "false-beacon:100@2s"),
)
SETTINGS = (
    *({"turn_deg": 20}, {"trial_deg": 30}, {"step_mm": 40}, {"look_choices": 3}, {"reach_mm": 120}, {"filter": 1}),
    *({"boredom_limit": 3}, {"speed_mm_s": 120}, {"turn_speed_deg_s": 90}, {"distrust": 20}),
)
FAULTS = (
    *("drop:2%", "drop:10%/to", "duplicate:5%", "delay:3%:40ms", "corrupt:2%", "drop@100-120", "reorder:5%"),
    *("truncate:2%", "flood:1%", "forge:2%:MEMORY"),
)


class Recorded(NamedTuple):
    """A run whose log is hashed.

    Attributes:
        name: What is special about it, and its seed.
        config: The run.
        edits: Whether `EDITS` are made.
        ticks: Maximum number of ticks of a step.
    """

    name: str
    config: RunConfig
    edits: bool = False
    ticks: int = BLOCK_TICKS


def runs() -> Iterator[Recorded]:
    """The runs, each under a name of its own."""
    for seed in range(1, 6):
        yield from _of_seed(seed)
    for seed, change in enumerate((*CHANGES, *CHANGES), 11):
        profile = "forgetful" if seed % 2 else "distance"
        yield _recorded(f"change {change}, {profile}", seed, profile=profile, changes=(change, "repair@11s"))
    for seed, settings in enumerate(SETTINGS, 41):
        yield _recorded(f"{settings}", seed, limit_s=30.0, settings=settings)
    for seed, fault in enumerate((*FAULTS, *FAULTS), 61):
        yield _recorded(f"fault {fault}", seed, faults=(fault,), robots=1 + seed % 2)


def _of_seed(seed: int) -> Iterator[Recorded]:
    for world in (*STILL_WORLDS, "docs/worlds/two_walls.toml"):
        yield _recorded(f"world {world}", seed, environments=2, limit_s=20.0, world=world)
    for profile in PROFILES:
        yield _recorded(f"behaviour {profile}", seed, limit_s=30.0, profile=profile)
    for robots in (2, 3, 6):
        yield _recorded(f"{robots} robots", seed, environments=2, limit_s=15.0, robots=robots)
    yield _recorded("all changes, 2 robots", seed, environments=2, robots=2, changes=(*CHANGES, "grow@env2"))
    yield _recorded("until it is finished", seed, limit_s=600.0)
    yield _recorded("over a socket pair", seed, bus="fd")
    yield _recorded("node 5", seed, node=5, owner=7)
    for robots, profile, ticks in ((1, "article", BLOCK_TICKS), (2, "distance", BLOCK_TICKS), (1, "searcher", 1)):
        config = RunConfig(seed=seed, environments=1, limit_s=12.0, robots=robots, profile=profile)
        yield Recorded(f"edits, {robots} {profile}, {ticks} ticks at once, seed {seed}", config, True, ticks)


def _recorded(name: str, seed: int, environments: int = 1, limit_s: float = 12.0, **others: object) -> Recorded:
    config = RunConfig(seed=seed, environments=environments, limit_s=limit_s, **others)
    return Recorded(f"{name}, seed {seed}", config)


def digest_of_log(recorded: Recorded) -> str:
    """The digest of a run's log; if a fault ends the run early, followed by the reason."""
    log, reason = FrameLog(), ""
    with make(recorded.config, log) as simulation:
        try:
            for number in range(1, recorded.config.environments + 1):
                _go_through(simulation, number, recorded)
            simulation.set_clock()
            for client in simulation.clients:
                stop(client)
        except RobotError as error:
            reason = str(error)
    return f"{log.close()} {reason}".rstrip()


def _go_through(simulation: Simulation, number: int, recorded: Recorded) -> None:
    simulation.enter(number)
    edits = {simulation.tick + tick: edit for tick, edit in EDITS.items()} if recorded.edits else {}
    while not simulation.over:
        if simulation.tick in edits:
            with suppress(EditError):
                simulation.edit(edits[simulation.tick])
        left = min((tick for tick in edits if tick > simulation.tick), default=sys.maxsize) - simulation.tick
        simulation.step(min(recorded.ticks, left))
    simulation.leave()


def fleets() -> Iterator[tuple[str, str]]:
    """Fleets, which have no log, and what they did."""
    for worlds in ("own", "one", "hall"):
        for seed, robots in ((1, 3), (2, 20)):
            if (worlds, robots) != ("one", 20):
                config = RunConfig(seed=seed, environments=2, limit_s=20.0, robots=robots, worlds=worlds)
                yield f"fleet of {robots}, {worlds}, seed {seed}", repr([*run_fleet(config)])


def hashes() -> dict[str, str]:
    """The digest of each run's log, and of what each fleet did, by name."""
    logs = {recorded.name: digest_of_log(recorded) for recorded in runs()}
    return logs | {name: hashlib.sha256(text.encode()).hexdigest() for name, text in fleets()}


def differences(before: dict[str, str], now: dict[str, str]) -> list[str]:
    """The names of the runs whose hashes differ, or that are in one of the two only."""
    return sorted(name for name in before.keys() | now.keys() if before.get(name) != now.get(name))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--against", type=Path, metavar="FILE", help="hashes printed earlier")
    arguments = parser.parse_args()
    now = hashes()
    if arguments.against is None:
        sys.stdout.write(json.dumps(now, indent=1) + "\n")
        return 0
    different = differences(json.loads(arguments.against.read_text()), now)
    sys.stdout.writelines(f"{name}\n" for name in different)
    sys.stdout.write(f"{len(different)} of {len(now)} differ\n")
    return int(bool(different))


if __name__ == "__main__":
    sys.exit(main())
