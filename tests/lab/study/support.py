"""Rows of runs that never were, for tests of what is made of rows."""

from host_sim.lab.study.contacts import BodyState, Contact
from host_sim.lab.study.sample import Sample, samples_of
from host_sim.lab.study.tables import tables_of
from host_sim.lab.study.trial import Row, Run, Trial
from host_sim.sim.run_config import RunConfig

NOTHING = (0,) * 8
SOUND, SWAPPED = BodyState(), BodyState(is_changed=True, is_reversed=True)
TICK_S = 0.02


def contact(blocked_s: float = 0.2, turns: int = 1, sides=NOTHING, cleared: bool = True, body=SOUND) -> Contact:
    return Contact(0, 1, round(blocked_s / TICK_S), 0, turns, 0, cleared, body, tuple(sides))


def row(robot_s: float = 100.0, contacts=(), **fields) -> Row:
    """An environment, with one robot."""
    known = {"number": 1, "finished": True, "collisions": 0, "denied": 0, "sides": [NOTHING], "bodies": [SOUND]}
    return Row(
        **{**known, "robot_s": robot_s, "tour_s": 20.0, "contacts": [list(contacts)], "tick_s": TICK_S, **fields}
    )


def trial(profile: str, seed: int, environments: int = 1, **options) -> Trial:
    return Trial(RunConfig(profile=profile, seed=seed, environments=environments, **options))


def run(condition: str, seed: int, *rows: Row, known_s: float | None = None, **options) -> Run:
    config = RunConfig(seed=seed, environments=len(rows), **options)
    return Run(Trial(config, condition), list(rows), [known_s], "")


def samples(*runs: Run) -> list[Sample]:
    return samples_of(tables_of(runs))
