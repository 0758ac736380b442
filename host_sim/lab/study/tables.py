"""The rows of a study: tables of its runs, their environments, and contacts, in which a robot was blocked."""

import json
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from host_sim.lab.study.trial import Run, knows_wrong
from host_sim.lab.study.version import code_version

COLUMNS: Mapping[str, Mapping[str, type]] = {
    "runs": {
        "condition": str,  # name of its condition
        "seed": int,  # its seed
        "profile": str,  # the behaviour
        "settings": str,  # parameters that differ from their defaults, as JSON
        "world": str,  # where the environments are drawn from
        "body": str,  # kind of the bodies
        "change": str,  # scheduled changes of world and bodies; empty for none
        "robots": int,  # number of robots
        "known_s": float,  # robot time until turns for patterns 1, 3, 4 and 6 were known, s; the median
        "log_sha256": str,  # digest of its log
        "code": str,  # version of the sources
        "command": str,  # command that repeats it
    },
    "environments": {
        "condition": str,  # name of its condition
        "seed": int,  # its seed
        "environment": int,  # its number, from 1
        "finished": bool,  # whether all food was eaten
        "robot_s": float,  # robot time, s
        "tour_s": float,  # robot time of the shortest tour, s; NaN where several robots share the environment
        "collisions": int,  # times that a body began to touch something
        "denied": int,  # times that wheels did not follow the command
        "wrong": int,  # robots that know a wrong turn for pattern 1, 3, 4 or 6 at the end
        "changed": bool,  # whether the change had been made
        "sides": str,  # the turns that each robot knows at the end, for patterns 0 to 7: 0, 1 left, 2 right
    },
    "contacts": {
        "condition": str,  # name of its condition
        "seed": int,  # its seed
        "environment": int,  # its number, from 1
        "robot": int,  # the robot, from 0
        "number": int,  # number of the contact, for each robot from 1 through all environments
        "changed": bool,  # whether the change had been made
        "begun_s": float,  # robot time from the start of the environment, s
        "pattern": int,  # pattern of the front sensors, 1 to 7
        "blocked_s": float,  # robot time until the way was clear, s
        "trials": int,  # random turns
        "remembered": int,  # remembered turns
        "boredoms": int,  # about-faces
        "cleared": bool,  # whether the way became clear
        "sides": str,  # the turns known at its end
        "wrong": bool,  # whether one of them is wrong
    },
}
"""The columns of each table, with the types of their values."""

Row = dict[str, Any]
Columns = dict[str, NDArray[Any]]
Tables = dict[str, Columns]
"""Tables by name; each has columns by name, with an entry for each row."""


def rows_of(run: Run) -> dict[str, list[Row]]:
    """A run's rows for each table."""
    key = {"condition": run.trial.key[0], "seed": run.trial.config.seed}
    return {
        "runs": [key | _run(run)],
        "environments": [key | row for row in _environments(run)],
        "contacts": [key | row for row in _contacts(run)],
    }


def tables_of(runs: Iterable[Run]) -> Tables:
    """The rows of runs as columns."""
    rows: dict[str, list[Row]] = {name: [] for name in COLUMNS}
    for run in runs:
        for name, more in rows_of(run).items():
            rows[name] += more
    return {
        table: {name: np.array([row[name] for row in rows[table]], _kind(kind)) for name, kind in columns.items()}
        for table, columns in COLUMNS.items()
    }


def _kind(kind: type) -> Any:
    return object if kind is str else kind


def _run(run: Run) -> Row:
    config, known = run.trial.config, run.known_s
    return {
        **_fields(config, "profile", "world", "body", "robots"),
        "settings": json.dumps(config.settings, sort_keys=True),
        "change": " ".join(config.changes),
        "known_s": float(np.median([np.inf if time is None else time for time in known])),
        "log_sha256": run.log_sha256,
        "code": code_version(),
        "command": config.command(),
    }


def _environments(run: Run) -> Iterator[Row]:
    for row in run.rows:
        yield {
            **_fields(row, "finished", "robot_s", "tour_s", "collisions", "denied"),
            "environment": row.number,
            "wrong": sum(map(knows_wrong, row.sides, row.bodies)),
            "changed": any(body.is_changed for body in row.bodies),
            "sides": " ".join(_digits(sides) for sides in row.sides),
        }


def _contacts(run: Run) -> Iterator[Row]:
    numbers: Counter[int] = Counter()
    for row in run.rows:
        for robot, contacts in enumerate(row.contacts):
            for contact in contacts:
                numbers[robot] += 1
                yield {
                    **_fields(contact, "pattern", "trials", "remembered", "boredoms", "cleared"),
                    "environment": row.number,
                    "robot": robot,
                    "number": numbers[robot],
                    "changed": contact.body.is_changed,
                    "begun_s": round(contact.tick * row.tick_s, 3),
                    "blocked_s": round(contact.blocked_ticks * row.tick_s, 3),
                    "sides": _digits(contact.sides),
                    "wrong": knows_wrong(contact.sides, contact.body),
                }


def _fields(of: object, *names: str) -> Row:
    return {name: getattr(of, name) for name in names}


def _digits(sides: Sequence[int]) -> str:
    return "".join(str(int(side)) for side in sides)
