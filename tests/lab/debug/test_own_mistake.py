"""The command that a mistake in one's own behaviour names: gdb opens at that decision, as gdb itself says."""

import re
import shlex
import sys
from pathlib import Path

import pytest

from host_sim.base.paths import PACKAGE
from tests.runs.support import octet_process

TEMPLATE = (PACKAGE / "program/own/mine.c").read_text()
WRONG = "brain->awaits = NOTHING;\n    brain->own[0] = (uint8_t)(9 / (pattern - {pattern}));"


def wrong(folder: Path, pattern: int = 1) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "my robot.c").write_text(TEMPLATE.replace("brain->awaits = NOTHING;", WRONG.format(pattern=pattern)))
    return folder / "my robot.c"


def run(source: Path, *options: str) -> str:
    done = octet_process("run", "--profile", source, "--quiet", "--bus", "fd", "--out", source.parent, *options)
    assert done.returncode == 1
    return done.stderr


@pytest.mark.parametrize("options", [(), ("--robots", "3"), ("--fast",), ("--fast", "--robots", "3")], ids=str)
def test_mistake_names_the_command_that_stops_at_its_decision(options, tmp_path):
    bus = ("--bus", "none") if "--fast" in options else ()
    said = run(wrong(tmp_path), *options, *bus)

    mistake, command, _ = said.split("\n")
    where = re.search(r"robot\.c:45:\d+: a division by zero, at tick (\d+), ([\d.]+) s", mistake)
    words = shlex.split(command.partition("tools/octet")[2])
    steps = ["continue", "continue", "up 2", "frame"]
    shown = octet_process(*words, *(word for step in steps for word in ("--ex", step))).stdout

    assert re.search(rf"^tick {where[1]}, {where[2]} s, 0 of \d+ drives differ", shown, re.MULTILINE)
    assert re.search(r"^Breakpoint 3, own_next .*my robot\.c:41$", shown, re.MULTILINE)
    assert re.search(r"own_next .*my robot\.c:45\n45\t", shown)


def test_mistake_in_a_later_environment_is_debugged_at_its_tick(tmp_path):
    said = run(wrong(tmp_path, 3), "--environments", "100", "--limit-s", "7")
    tick = re.search(r"--tick (\d+)", said)[1]

    debug = ["debug", tmp_path / "run.log", "--tick", tick, "--profile", tmp_path / "my robot.c"]
    shown = octet_process(*debug, "--ex", "continue", "--ex", "output/u pattern_of(senses->feel)").stdout

    assert int(tick) > 350
    assert shown.endswith("3")


def test_mistake_before_the_first_tick_names_no_command(tmp_path):
    source = wrong(tmp_path)
    source.write_text(TEMPLATE.replace("return true;", "return 1 / (brain->memory.cell[0] * 0) == 1;"))

    assert run(source).count("\n") == 1


def test_source_that_came_with_a_log_is_compiled_only_on_request(tmp_path):
    run(wrong(tmp_path))
    log, words = tmp_path / "run.log", ("--ex", "continue", "--ex", "list 45,45")

    refused, shown = octet_process("debug", log, *words), octet_process("debug", log, "--compile", *words)

    assert refused.returncode == 2
    assert "if you trust those who sent the log, --compile" in refused.stderr
    assert "9 / (pattern - 1)" in shown.stdout


def test_debug_of_a_log_without_its_world_file_asks_for_the_source(tmp_path):
    run(wrong(tmp_path))
    (tmp_path / "run.world.json").unlink()

    done = octet_process("debug", tmp_path / "run.log", "--tick", "3")

    assert done.returncode == 2
    assert "had a behaviour of its own: add --profile MINE.C, its file" in done.stderr


def test_robot_with_own_behaviour_starts_in_gdb(tmp_path):
    source = tmp_path / "mine.c"
    source.write_text(TEMPLATE)
    run = ["run", "--profile", source, "--environments", "1", "--limit-s", "2", "--out", tmp_path]

    done = octet_process(*run, "--gdb", input="next\nnext\ninfo locals\ndelete\ncontinue\nquit\n")

    assert "Breakpoint 1, own_next " in done.stdout
    assert "pattern = 0 " in done.stdout
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "summary.json").exists()


def test_missing_debug_build_is_reported(monkeypatch, tmp_path, capsys):
    from host_sim.cli.main import main  # noqa: PLC0415 - the other tests start processes
    from host_sim.sim import own_brain  # noqa: PLC0415

    run(wrong(tmp_path))
    missing = {**own_brain._LINKS, "octet-debug": (own_brain._MADE_DEBUG / "no.o", [])}
    monkeypatch.setattr(own_brain, "_LINKS", missing)
    monkeypatch.setattr(own_brain, "_CACHE", tmp_path / "cache")
    monkeypatch.setattr(sys, "argv", ["octet"])

    assert main(["debug", str(tmp_path / "run.log"), "--profile", str(tmp_path / "my robot.c")]) == 1

    assert "no.o is not built: run tools/setup debug" in capsys.readouterr().err
