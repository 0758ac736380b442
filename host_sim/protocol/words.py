"""The words and ranges of the command line, read from octet.dbc: they are needed before anything is generated."""

import re
from typing import NamedTuple

from host_sim.base.paths import ROOT

_PROTOCOL = ROOT / "hal" / "protocol"
_DBC = (_PROTOCOL / "octet.dbc").read_text(encoding="utf-8")
_WORDS = (_PROTOCOL / "robot.toml").read_text(encoding="utf-8")
_PARAMETER = re.compile(r'^EV_ (\w+): 0 \[(\d+)\|(\d+)\] "(.*)" (\d+) (\d+) .*;', re.MULTILINE)
_COMMENTS = dict(re.findall(r'^CM_ EV_ (\w+) "(.*)";', _DBC, re.MULTILINE))


def _found(pattern: str, text: str) -> str:
    found = re.search(pattern, text, re.MULTILINE)
    assert found is not None
    return found[1]


class Parameter(NamedTuple):
    """A number that the robot is set up with."""

    number: int
    minimum: int
    maximum: int
    default: int
    unit: str
    comment: str


NODE_MAX = int(_found(r"^node_max = (\d+)", _WORDS))
"""The last node number."""

_COMMAND = _found(r"^BO_ (\d+) COMMAND:", _DBC)
*_BUILT_IN, OWN = re.findall(r'"(\w+)"', _found(rf"^VAL_ {_COMMAND} profile (.*);", _DBC))
PROFILES: tuple[str, ...] = tuple(_BUILT_IN)
"""The behaviours that every robot has; a user's own behaviour is the profile `OWN`."""

SENSORS, BODY_FAULTS = (
    tuple(re.findall(r'"([\w-]+)"', _found(rf"^{name} = \[([^]]*)\]", _WORDS))) for name in ("feel", "body_faults")
)
"""The proximity sensors, from bit 0 of feel on, and what can be wrong with a body, as changes call them."""

KIT_SETTINGS = {
    name: int(value) for name, value in re.findall(r"(\w+) = (\d+)", _found(r"^\[kit_settings\]\n([^[]*)", _WORDS))
}
"""Parameters that a robot with a body of the kit is set to, unless a run says otherwise."""

_ALL = {
    name: Parameter(int(number), int(low), int(high), int(default), unit, _COMMENTS[name])
    for name, low, high, unit, default, number in _PARAMETER.findall(_DBC)
}
PARAMETERS = {name: row for name, row in _ALL.items() if not name.startswith("body_")}
"""The robot's parameters, by name."""

BODY_PARAMETERS = {name: row for name, row in _ALL.items() if name not in PARAMETERS}
"""The parameters of a body on pins: the commands and results of its calibration."""
