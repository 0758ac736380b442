"""The rows of a study: tables of its runs, their environments, and contacts, in which a robot was blocked."""

import json
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from host_sim.lab.study.trial import Run, knows_wrong
from host_sim.lab.study.version import code_version


class Column(NamedTuple):
    """A column of a table: the type and meaning of its values."""

    kind: type
    meaning: str


COLUMNS: Mapping[str, Mapping[str, Column]] = {
    "runs": {
        "condition": Column(str, "name of its condition"),
        "seed": Column(int, "its seed"),
        "profile": Column(str, "the behaviour"),
        "settings": Column(str, "parameters that differ from their defaults, as JSON"),
        "world": Column(str, "where the environments are drawn from"),
        "body": Column(str, "what the bodies are like"),
        "change": Column(str, "what world and bodies met with; empty for nothing"),
        "robots": Column(int, "number of robots"),
        "known_s": Column(float, "robot time until turns for patterns 1, 3, 4 and 6 were known, s; the median"),
        "log_sha256": Column(str, "digest of its log"),
        "code": Column(str, "version of the sources"),
        "command": Column(str, "what repeats it"),
    },
    "environments": {
        "condition": Column(str, "name of its condition"),
        "seed": Column(int, "its seed"),
        "environment": Column(int, "its number, from 1"),
        "finished": Column(bool, "whether all food was eaten"),
        "robot_s": Column(float, "robot time, s"),
        "tour_s": Column(float, "robot time of the shortest tour, s; NaN where several robots share the environment"),
        "collisions": Column(int, "times that a body began to touch something"),
        "denied": Column(int, "times that wheels did not do what they were told"),
        "wrong": Column(int, "robots that know a wrong turn for pattern 1, 3, 4 or 6 in the end"),
        "changed": Column(bool, "whether the change had been made"),
        "sides": Column(str, "the turns that each robot knows in the end, for patterns 0 to 7: 0, 1 left, 2 right"),
    },
    "contacts": {
        "condition": Column(str, "name of its condition"),
        "seed": Column(int, "its seed"),
        "environment": Column(int, "its number, from 1"),
        "robot": Column(int, "the robot, from 0"),
        "number": Column(int, "the contacts of this robot, counted from 1 through all environments"),
        "changed": Column(bool, "whether the change had been made"),
        "begun_s": Column(float, "robot time from the start of the environment, s"),
        "pattern": Column(int, "what the front sensors said, 1 to 7"),
        "blocked_s": Column(float, "robot time until the way was clear, s"),
        "trials": Column(int, "random turns"),
        "remembered": Column(int, "remembered turns"),
        "boredoms": Column(int, "about-faces"),
        "cleared": Column(bool, "whether the way became clear"),
        "sides": Column(str, "the turns known in the end"),
        "wrong": Column(bool, "whether one of them is wrong"),
    },
}
"""The columns of each table."""

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
        table: {name: np.array([row[name] for row in rows[table]], _kind(it.kind)) for name, it in columns.items()}
        for table, columns in COLUMNS.items()
    }


def _kind(kind: type) -> Any:
    return object if kind is str else kind


def _run(run: Run) -> Row:
    config, known = run.trial.config, run.known_s
    return {
        "profile": config.profile,
        "settings": json.dumps(config.settings, sort_keys=True),
        "world": config.world,
        "body": config.body,
        "change": " ".join(config.changes),
        "robots": config.robots,
        "known_s": float(np.median([np.inf if time is None else time for time in known])),
        "log_sha256": run.log_sha256,
        "code": code_version(),
        "command": config.command(),
    }


def _environments(run: Run) -> Iterator[Row]:
    for row in run.rows:
        yield {
            "environment": row.number,
            "finished": row.finished,
            "robot_s": row.robot_s,
            "tour_s": row.tour_s,
            "collisions": row.collisions,
            "denied": row.denied,
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
                    "environment": row.number,
                    "robot": robot,
                    "number": numbers[robot],
                    "changed": contact.body.is_changed,
                    "begun_s": round(contact.tick * row.tick_s, 3),
                    "pattern": contact.pattern,
                    "blocked_s": round(contact.blocked_ticks * row.tick_s, 3),
                    "trials": contact.trials,
                    "remembered": contact.remembered,
                    "boredoms": contact.boredoms,
                    "cleared": contact.cleared,
                    "sides": _digits(contact.sides),
                    "wrong": knows_wrong(contact.sides, contact.body),
                }


def _digits(sides: Sequence[int]) -> str:
    return "".join(str(int(side)) for side in sides)
