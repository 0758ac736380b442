"""Rows of runs that never were, for tests of what is made of rows."""

from typing import Any

from host_sim.lab.study.contacts import BodyState, digits_of, knows_wrong
from host_sim.lab.study.sample import Sample, samples_of
from host_sim.lab.study.tables import COLUMNS, Row, Rows, tables_of
from host_sim.lab.study.trial import Trial
from host_sim.sim.run_config import RunConfig

NOTHING = (0,) * 8
SOUND, SWAPPED = BodyState(), BodyState(is_changed=True, is_reversed=True)


def blank(table: str, **known: Any) -> Row:
    """A row with what is known, and else nothing."""
    return {name: kind() for name, kind in COLUMNS[table].items()} | known


def of_body(sides, body: BodyState) -> Row:
    return {"sides": digits_of(sides), "changed": body.is_changed, "wrong": knows_wrong(sides, body)}


def contact(blocked_s: float = 0.2, turns: int = 1, sides=NOTHING, cleared: bool = True, body=SOUND) -> Row:
    return blank("contacts", blocked_s=blocked_s, remembered=turns, cleared=cleared, **of_body(sides, body))


def row(robot_s: float = 100.0, contacts=(), sides=NOTHING, body=SOUND, **fields) -> tuple[Row, list[Row]]:
    """An environment with its contacts."""
    known = {"finished": True, "robot_s": robot_s, "tour_s": 20.0, **of_body(sides, body), **fields}
    return blank("environments", **known), list(contacts)


def trial(profile: str, seed: int, environments: int = 1, **options) -> Trial:
    return Trial(RunConfig(profile=profile, seed=seed, environments=environments, **options))


def run(condition: str, seed: int, *rows, known_s: float = float("inf"), robots: int = 1) -> Rows:
    """A run with these environments."""
    key = {"condition": condition, "seed": seed}
    places = [key | {"environment": number} for number in range(1, len(rows) + 1)]
    return {
        "runs": [blank("runs", **key, robots=robots, known_s=known_s)],
        "environments": [it | place for (it, _), place in zip(rows, places, strict=True)],
        "contacts": [it | place for (_, met), place in zip(rows, places, strict=True) for it in met],
    }


def samples(*runs: Rows) -> list[Sample]:
    return samples_of(tables_of(runs))
