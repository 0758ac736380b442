"""`tools/run` with a fleet: its files, its lines, and what it refuses."""

import csv
import json
import os
from concurrent.futures import ThreadPoolExecutor
from hashlib import sha256
from pathlib import Path
from unittest import mock

import pytest
from PIL import Image

from host_sim.cli.run_options import RunOptions
from host_sim.sim import native_fleet
from host_sim.sim.option import flag_of, options_of
from tests.runs.support import octet

SHORT = ("--environments", "2", "--limit-s", "20", "--seed", "3")


def table(folder: Path) -> list[dict[str, str]]:
    with (folder / "robots.csv").open() as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def fleet(tmp_path_factory) -> tuple[str, Path]:
    """A run of forty robots: what it said, and its folder."""
    folder = tmp_path_factory.mktemp("fleet")
    done = octet("run", "--robots", "40", *SHORT, "--out", folder)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout, folder


def test_more_robots_than_node_numbers_have_a_world_each(fleet):
    text, _ = fleet

    assert text.startswith("fleet     40 robots, each in its own world, profile article, seeds from 3\n")
    assert "environment 2   " in text
    assert "learned   front-right: left " in text


def test_table_has_a_row_for_each_robot_and_environment(fleet):
    rows = table(fleet[1])

    assert [(row["robot"], row["environment"]) for row in rows] == [
        (str(robot), number) for robot in range(1, 41) for number in "12"
    ]
    assert rows[-1]["seed"] == "42"
    assert all(int(row["ticks"]) <= 1000 for row in rows)


def test_summary_adds_up_the_table(fleet):
    summary, rows = json.loads((fleet[1] / "summary.json").read_text()), table(fleet[1])

    assert summary["robot_ticks"] == sum(int(row["ticks"]) for row in rows)
    for environment in summary["environments"]:
        assert all(sum(counts) == 40 for counts in environment["learned"])
    right = [row for row in rows if row["environment"] == "2" and row["memory"][2:4] == "01"]
    assert summary["environments"][1]["learned"][1][1] == len(right) > 0


def test_fleet_picture_has_its_full_width_and_colours(fleet):
    with Image.open(fleet[1] / "fleet.png") as picture:
        assert picture.width == 1680
        assert len(picture.getcolors()) > 20


def test_robot_of_a_fleet_equals_the_robot_of_a_run_with_its_seed(fleet, tmp_path):
    done = octet("run", "--environments", "2", "--limit-s", "20", "--seed", "9", "--bus", "none", "--out", tmp_path)

    alone = json.loads((tmp_path / "summary.json").read_text())
    last = next(row for row in reversed(table(fleet[1])) if row["seed"] == "9")
    assert done.returncode == 0
    assert last["memory"] == bytes(alone["robots"][0]["memory"]).hex()
    assert int(last["trials"]) == alone["environments"][1]["robots"][0]["trials"]


def test_fleet_is_the_same_on_any_number_of_processors(monkeypatch, tmp_path):
    def files_on(processors: int) -> dict[str, str]:
        monkeypatch.setattr(os, "cpu_count", lambda: processors)
        with mock.patch.object(native_fleet, "ThreadPoolExecutor", wraps=ThreadPoolExecutor) as threads:
            octet("run", "--robots", "120", "--body", "kit", *SHORT, "--out", tmp_path)
        assert threads.call_args_list == [mock.call(processors)] * threads.call_count != []
        summary = json.loads((tmp_path / "summary.json").read_text())
        digests = {path.name: sha256(path.read_bytes()).hexdigest() for path in tmp_path.iterdir()}
        return digests | {"summary.json": str({**summary, "wall_s": 0, "real_time_factor": 0})}

    assert files_on(1) == files_on(2) == files_on(3)


@pytest.mark.parametrize("world", ["random", "posts"])
def test_fleet_in_one_world_is_drawn_there(tmp_path, world):
    done = octet("run", "--robots", "35", "--worlds", "one", "--world", world, *SHORT, "--json", "--out", tmp_path)

    assert json.loads(done.stdout)["worlds"] == "one"
    with Image.open(tmp_path / "fleet.png") as picture:
        assert picture.height > 1300


def test_fleet_in_a_hall_is_drawn_whole(tmp_path):
    done = octet("run", "--robots", "120", "--worlds", "hall", *SHORT, "--out", tmp_path)

    assert done.stdout.startswith("fleet     120 robots, all in one hall")
    with Image.open(tmp_path / "fleet.png") as picture:
        assert picture.height > 1200


REFUSED = {
    "an unknown world": (("--world", "corridor"), "did you mean corridors?"),
    "too many for one world": (("--worlds", "one"), "1000 robots are too many for one world with seed 3"),
    "too many for a hall": (("--worlds", "hall", "--robots", "10001"), "at most 10000 robots share a world"),
    "a bus": (("--bus", "fd"), "leave --bus fd out"),
    "memory files": (("--memory", "robot.mem"), "leave --memory out"),
    "real time": (("--real-time",), "leave --real-time out"),
    "another robot": (("--robot", "emulated"), "leave --robot out"),
    "a robot of one's own": (("--robot-command", "./robot"), "leave --robot-command out"),
    "a program": (("--profile", "mine.bas"), "name a built-in behaviour or a C file"),
    "a node number": (("--node", "5"), "leave --node out"),
    "the reference physics": (("--physics", "pymunk"), "leave --physics pymunk out"),
    "a compressed log": (("--compress-log",), "leave --compress-log out"),
    "a behaviour of one's own that is not there": (("--profile", "no.c"), "there is no file no.c"),
    "an unchecked behaviour": (("--fast",), "leave --fast out"),
    "a debugger": (("--gdb",), "--gdb debugs one robot"),
    "changes": (("--change", "plant@5s"), "leave --change out"),
    "faults": (("--fault", "drop:1%"), "leave --fault out"),
    "people who watch": (("--watch",), "a fleet cannot be watched"),
    "distances": (("--profile", "distance"), "profile distance needs distances"),
    "more than a fleet can be": (("--robots", "100001"), "1 to 100000"),
}


@pytest.mark.parametrize(("words", "reason"), REFUSED.values(), ids=REFUSED)
def test_option_that_a_fleet_does_not_have_is_refused(tmp_path, words, reason):
    done = octet("run", "--robots", "1000", *SHORT, "--out", tmp_path / "out", *words)

    assert done.returncode == 2
    assert done.stderr.startswith("octet: ")
    assert done.stderr.count("\n") == 1
    assert reason in done.stderr
    assert not (tmp_path / "out").exists()


def test_refused_options_include_all_that_the_table_keeps_from_fleets():
    kept = {flag_of(name, row) for name, (_, row) in options_of(RunOptions).items() if not row.fleet}

    assert kept <= {words[0] for words, _ in REFUSED.values()}


def test_watch_refuses_a_fleet():
    done = octet("watch", "--robots", "32")

    assert done.returncode == 2
    assert "up to 31 robots" in done.stderr
