"""The rows of a study: a table of runs, one of environments and one of contacts.

| runs        | a run                                                                                |
| ----------- | ------------------------------------------------------------------------------------ |
| condition   | name of its condition                                                                |
| seed        | its seed                                                                             |
| profile     | the behaviour                                                                        |
| settings    | parameters that differ from their defaults, as JSON                                  |
| world       | where the environments are drawn from                                                |
| change      | what world and bodies met with; empty for nothing                                    |
| robots      | number of robots                                                                     |
| known_s     | robot time until a turn was known for patterns 1, 3, 4 and 6, s, the robots' median  |
| log_sha256  | digest of its log                                                                    |
| code        | version of the sources                                                               |
| command     | what repeats it                                                                      |

| environments | an environment of a run                                                             |
| ------------ | ----------------------------------------------------------------------------------- |
| condition    | as above                                                                            |
| seed         | as above                                                                            |
| environment  | its number, from 1                                                                  |
| finished     | whether all food was eaten                                                          |
| robot_s      | robot time, s                                                                       |
| collisions   | times that a body began to touch something                                          |
| wrong        | robots that know a wrong turn for pattern 1, 3, 4 or 6 in the end                   |
| changed      | whether the change had been made                                                    |
| sides        | the turns that each robot knows in the end, for patterns 0 to 7: 0, 1 left, 2 right |

| contacts    | a time that a robot was blocked                                                      |
| ----------- | ------------------------------------------------------------------------------------ |
| condition   | as above                                                                             |
| seed        | as above                                                                             |
| environment | as above                                                                             |
| robot       | the robot, from 0                                                                    |
| number      | the contacts of this robot, counted from 1 through all environments                  |
| changed     | whether the change had been made                                                     |
| begun_s     | robot time from the start of the environment, s                                      |
| pattern     | what the front sensors said, 1 to 7                                                  |
| blocked_s   | robot time until the way was clear, s                                                |
| trials      | random turns                                                                         |
| remembered  | remembered turns                                                                     |
| boredoms    | about-faces                                                                          |
| cleared     | whether the way became clear                                                         |
| sides       | the turns known in the end                                                           |
| wrong       | whether one of them is wrong                                                         |
"""

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
        "condition": str,
        "seed": int,
        "profile": str,
        "settings": str,
        "world": str,
        "change": str,
        "robots": int,
        "known_s": float,
        "log_sha256": str,
        "code": str,
        "command": str,
    },
    "environments": {
        "condition": str,
        "seed": int,
        "environment": int,
        "finished": bool,
        "robot_s": float,
        "collisions": int,
        "wrong": int,
        "changed": bool,
        "sides": str,
    },
    "contacts": {
        "condition": str,
        "seed": int,
        "environment": int,
        "robot": int,
        "number": int,
        "changed": bool,
        "begun_s": float,
        "pattern": int,
        "blocked_s": float,
        "trials": int,
        "remembered": int,
        "boredoms": int,
        "cleared": bool,
        "sides": str,
        "wrong": bool,
    },
}
"""The columns of each table."""

Row = dict[str, Any]
Columns = dict[str, NDArray[Any]]
Tables = dict[str, Columns]
"""Each table by its name; each column by its name, one entry for each row."""


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
        name: {column: np.array([row[column] for row in rows[name]], _kind(kind)) for column, kind in kinds.items()}
        for name, kinds in COLUMNS.items()
    }


def _kind(kind: type) -> Any:
    return object if kind is str else kind


def _run(run: Run) -> Row:
    config, known = run.trial.config, run.known_s
    return {
        "profile": config.profile,
        "settings": json.dumps(config.settings, sort_keys=True),
        "world": config.world,
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
            "collisions": row.collisions,
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
