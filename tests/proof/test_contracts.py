"""What no input does, whatever state the robot is in: a static analyser follows all of them at once.

Each function of contracts.c is one case. Frama-C's Eva says whether its assertions hold, and its Inout, what of the
robot can be written at all in that case: what it does not name is proved to stay as it was.
"""

import re
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.proof.parts import HERE, ROBOT

ANALYSIS = ("-eva", "-eva-precision", "1", "-out")
MEMORY = "robot.brain.memory"
ORDERED = ("robot.config", "robot.brain.profile", "robot.brain.frozen")
"""What only a command changes."""


class Case(NamedTuple):
    """What stays as it was in a case, and what does not: that is the control."""

    untouched: Sequence[str]
    written: str


CASES = {
    "silence": Case((MEMORY, *ORDERED, "robot.motion", "robot.running", "robot.brain.random"), "robot.silences"),
    "another_robots_memory": Case((MEMORY, *ORDERED, "robot.motion", "robot.running"), "robot.sharing"),
    "any_command": Case((), MEMORY),
    "command_that_is_not_about_the_memory": Case((MEMORY, "robot.brain.profile"), "robot.running"),
    "any_senses": Case(ORDERED, MEMORY),
    "senses_of_a_stopped_robot": Case((MEMORY, *ORDERED, "robot.motion", "robot.brain.random"), "robot.uptime_s"),
    "senses_of_a_frozen_robot": Case((MEMORY,), "robot.brain.awaits"),
    "senses_of_fixed": Case((MEMORY,), "robot.brain.awaits"),
    "senses_of_article_without_a_trial": Case((MEMORY,), "robot.brain.awaits"),
}


@pytest.fixture(scope="module")
def parsed(frama_c: Callable[..., str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All of it, read once."""
    saved = tmp_path_factory.mktemp("contracts") / "parsed.sav"
    files = (HERE / "any/any.c", HERE / "contracts.c", *ROBOT)
    frama_c(*files, "-save", saved)
    return saved


def written(report: str) -> list[str]:
    """What of the robot may be written while it responds, as paths like robot.brain.awaits."""
    found = re.search(r"Out \(internal\) for function robot_respond:\n(.*?)\n\[", report, re.DOTALL)
    zones = split("".join(found[1].split()))
    return [path for zone in zones for path in paths(zone) if path.split(".")[0].startswith("robot")]


def split(zones: str) -> list[str]:
    """The parts between the semicolons that stand in no brace."""
    parts, depth = [""], 0
    for letter in zones:
        depth += (letter == "{") - (letter == "}")
        if letter == ";" and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return parts


def paths(zone: str) -> Iterator[str]:
    """Of a{.b;.c}: a.b and a.c."""
    head, brace, inner = zone.partition("{")
    if not brace:
        yield zone
        return
    for part in split(inner.removesuffix("}")):
        yield from (head + path for path in paths(part))


def touches(path: str, whole: str) -> bool:
    """Whether one is the other or a part of it. What is told in bits may be anything of what they are of."""
    path = path.partition("[")[0]
    return f"{path}.".startswith(f"{whole}.") or f"{whole}.".startswith(f"{path}.")


@pytest.mark.parametrize("name", CASES)
def test_what_must_not_change_stays_as_it_was(frama_c, parsed, name):
    report = frama_c("-load", parsed, *ANALYSIS, "-main", name)
    may_be_written = written(report)

    assert [path for path in may_be_written for whole in CASES[name].untouched if touches(path, whole)] == []
    assert any(touches(path, CASES[name].written) for path in may_be_written)
    assert "[eva:alarm]" not in report
    assert "0 alarms generated" in report


def test_an_assertion_that_does_not_hold_is_found(frama_c, parsed):
    report = frama_c("-load", parsed, *ANALYSIS, "-main", "any_drive_is_at_rest")

    assert "[eva:alarm]" in report
    assert "assertion 'at_rest' got status unknown" in report


def test_paths_are_read_as_they_are_written():
    zone = "robot{.a;{.b.c;.d{.e;.f}}}"

    assert list(paths(zone)) == ["robot.a", "robot.b.c", "robot.d.e", "robot.d.f"]
    assert touches("robot.brain", MEMORY)
    assert touches("robot", MEMORY)
    assert touches("robot.brain.memory.cell[3]", MEMORY)
    assert not touches("robot.brain.memory_kind", MEMORY)
