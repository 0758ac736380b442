"""Runs in the world whose obstacles can be pushed: the same wherever, and from the log, with pymunk only."""

import json

import pytest

from host_sim.recording.resimulation import resimulate
from host_sim.recording.world_file import read_world
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.world.crates import Crates
from host_sim.world.edits import Edit
from tests.runs.support import octet, unpacked

BLIND = [word for sensor in ("front", "front-left", "front-right") for word in ("--change", f"stuck-off:{sensor}@0s")]
BRIEF = ("--world", "crates", "--environments", "2", "--limit-s", "20", "--seed", "2", *BLIND)


def test_a_run_is_the_same_over_another_bus_and_repeated_from_its_log(run):
    done = run(*BRIEF, "--bus", "none")

    assert (done.code, done.errors) == (0, "")
    assert done.log == run(*BRIEF, "--bus", "fd").log
    pushes = [edit for _, edit in read_world(done.out / "run.world.json").edits if edit.do == "push_bar"]
    repeated = resimulate(done.out / "run.log")
    assert len(pushes) > 10
    assert repeated.trajectory.ticks == 2000
    assert octet("replay", str(done.out / "run.log")).returncode == 0


def test_pushes_are_no_news_and_their_page_says_why_it_cannot_ask_what_if(run):
    done = run(*BRIEF, "--bus", "none")
    page = unpacked((done.out / "replay.html").read_text())

    assert "What if? cannot repeat this run: pymunk moved its crates." in page
    assert not any("push" in sentence for _, sentence in resimulate(done.out / "run.log").trajectory.news)
    assert json.loads((done.out / "summary.json").read_text())["world"] == "crates"


@pytest.mark.parametrize("ends", [((-1.0, 500.0), (200.0, 500.0)), ((500.0, 500.0), (550.0, 550.0))], ids=str)
def test_a_crate_that_cannot_be_where_it_is_pushed_stays_where_it_was(monkeypatch, ends):
    """A person can put one halfway into a wall, or make it so short that rounding is too much for it."""
    monkeypatch.setattr(Crates, "push", lambda *_: [Edit("push_bar", 0, a=ends[0], b=ends[1])])
    with make(RunConfig(world="crates", environments=1, limit_s=0.2)) as simulation:
        simulation.enter(1)
        before = simulation.arena.obstacles.bars
        while not simulation.over:
            simulation.step()

    assert simulation.tick == 10
    assert simulation.arena.obstacles.bars == before
    assert simulation.record.edits == []


@pytest.mark.parametrize(
    "words",
    [("--physics", "fast"), ("--robots", "2", "--worlds", "own"), ("--robots", "40")],
    ids=" ".join,
)
def test_what_cannot_push_is_refused_in_a_line(tmp_path, words):
    done = octet("run", "--world", "crates", *words, "--out", str(tmp_path / "out"))

    assert done.returncode == 2
    assert done.stderr == "octet: only pymunk can push what --world crates has: no --physics fast, and no fleet\n"
    assert not (tmp_path / "out").exists()
