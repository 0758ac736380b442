"""Random schedules of faults: drawn alike from a seed, compared with the clean run, and shrunk where they fail."""

import re
from collections import Counter

from host_sim.lab.campaign import walk
from host_sim.lab.campaign.cell import LOCKSTEP, Cell
from host_sim.lab.campaign.matrix import HOST, LINE, ROBOT
from host_sim.lab.campaign.outcome import Outcome
from host_sim.transport.rule import FAULT_NAMES, Rule
from tests.runs.support import octet

LINKS = ("none", "fd", "slcan", "blue_pill")
WHERE = (LINKS, ["article", "adaptive"], 6.0)


def drawn(count, seed):
    return [cell for _, *cells in walk.walk(count, seed, *WHERE) for cell in cells]


def test_the_same_seed_draws_the_same_schedules():
    first, again, other = (list(map(str, drawn(30, seed))) for seed in (1, 1, 2))

    assert first == again
    assert len(first) == 30
    assert not {*first} & {*other}


def test_schedules_have_one_to_six_faults_of_all_kinds_and_can_be_repeated():
    cells = drawn(1000, 1)

    assert {len(cell.faults) + bool(cell.events) for cell in cells} <= set(range(1, 7))
    assert {Rule.parse(rule).name for cell in cells for rule in cell.faults} == {*FAULT_NAMES}
    events = Counter(event.name for cell in cells for event in cell.events)
    assert {"reset", "hang", "hold-up", "kill", "flash-cut", "disk-full", "unplug", "kill-simulator"} <= events.keys()
    classes = [it for it in (*ROBOT, *LINE, *HOST) for link in LINKS if it.can_happen("article", link, LOCKSTEP)]
    assert events.keys() == {it.partition(":")[0] for each in classes for it in each.event.split()} - {"kill-saving"}
    assert any("SENSES" in rule and not rule.endswith("/to") for cell in cells for rule in cell.faults)
    assert [str(Cell.parse(str(cell))) for cell in cells] == list(map(str, cells))


def test_random_schedules_change_nothing_without_a_warning():
    done = octet("campaign", "--walk", "40", "--links", *LINKS, "--limit-s", "6")

    assert (done.returncode, done.stderr) == (0, "")
    assert re.search(r"^\d+ runs: 0 not as they should be", done.stdout, re.M)


def test_a_schedule_that_changes_a_run_without_a_warning_is_shrunk(monkeypatch):
    guilty = "event=clock-back:3600@40"
    schedule = Cell.parse(f"article none lockstep seed=1 limit=2 fault=duplicate@30-40/to {guilty}")
    monkeypatch.setattr(walk, "_drawn", lambda *_: schedule)

    def run_cell(cell):
        return Outcome(cell, course="another" if cell.events else "clean")

    monkeypatch.setattr("host_sim.lab.campaign.running.run_cell", run_cell)

    done = octet("campaign", "--walk", "1", "--limit-s", "2", "--profiles", "article")

    assert done.returncode == 1
    assert re.search(rf"^  shortest: .*'article none lockstep seed=1 limit=0.5 {guilty}'$", done.stderr, re.M)
