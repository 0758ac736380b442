"""The rows of a study: tables of its runs, their environments, and contacts, in which a robot was blocked."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

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

Columns = dict[str, NDArray[Any]]
Tables = dict[str, Columns]
"""Tables by name; each has columns by name, with an entry for each row."""

Row = dict[str, Any]
Rows = dict[str, list[Row]]
"""The rows of a run in each table."""


def tables_of(runs: Iterable[Rows]) -> Tables:
    """The rows of runs as columns."""
    every = list(runs)
    rows = {table: [row for run in every for row in run[table]] for table in COLUMNS}
    return {
        table: {
            name: np.array([row[name] for row in rows[table]], object if kind is str else kind)
            for name, kind in columns.items()
        }
        for table, columns in COLUMNS.items()
    }
