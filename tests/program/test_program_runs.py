"""Robots whose brain is a program: docs/article.md."""

import hashlib
from pathlib import Path

import pytest

from host_sim.api import RunConfig, UsageError, run
from host_sim.base.paths import ROOT
from host_sim.cli.main import main

EXAMPLES = ROOT / "host_sim/program/examples"
ARTICLE = EXAMPLES / "article.bas"


def test_figures_of_the_article_s_program_are_unchanged():
    figures = ARTICLE.read_text().partition("// What the article has in its downloads")[0]

    assert hashlib.sha256(figures.encode()).hexdigest()[:16] == "d4d25e444d14bb1c"


@pytest.mark.parametrize("seed", range(1, 21))
def test_article_s_program_learns_the_same_cells_as_the_firmware(seed):
    program = run(RunConfig(seed=seed, profile=str(ARTICLE)))

    assert program.memories == run(RunConfig(seed=seed)).memories


@pytest.fixture
def without_pause(tmp_path):
    """The article's program, but for the pause between two environments, which the firmware does not make."""
    program = tmp_path / "article.bas"
    program.write_text(ARTICLE.read_text().replace("delay 2000", "delay 0"))
    return str(program)


@pytest.mark.parametrize("seed", [1, 4, 7])
def test_program_without_its_pause_sends_the_firmware_s_frames(seed, without_pause):
    program = run(RunConfig(seed=seed, profile=without_pause))

    assert program.log_sha256 == run(RunConfig(seed=seed)).log_sha256


def test_program_on_a_kit_body_sends_the_firmware_s_frames(without_pause):
    config = {"seed": 2, "environments": 1, "body": "kit", "settings": {"step_mm": 12}}

    assert run(RunConfig(profile=without_pause, **config)).log_sha256 == run(RunConfig(**config)).log_sha256


def test_program_behind_a_link_sends_the_same_frames():
    config = {"seed": 3, "environments": 2, "profile": str(ARTICLE)}

    assert run(RunConfig(bus="fd", **config)).log_sha256 == run(RunConfig(**config)).log_sha256


def test_several_robots_have_a_program_each():
    done = run(RunConfig(seed=1, environments=1, robots=3, profile=str(ARTICLE)))

    assert len(set(done.memories)) > 1


@pytest.mark.parametrize("name", [path.name for path in EXAMPLES.iterdir()])
def test_examples_run_without_a_mistake(name):
    run(RunConfig(environments=1, limit_s=10, profile=str(EXAMPLES / name)))


def written(folder: Path, text: str) -> str:
    path = folder / "own.bas"
    path.write_text(text)
    return str(path)


def test_mistake_is_reported_with_its_line_before_the_run_begins(tmp_path, capsys):
    program = written(tmp_path, "x = 1\nrTrun 5\n")
    out = tmp_path / "out"

    assert main(["run", "--profile", program, "--out", str(out), "--bus", "none"]) == 2

    told = capsys.readouterr()
    expected = "expected a command, a label, or a variable with = after it"
    assert told.err == f'octet: {program}, line 2: "rTrun": {expected}\n'
    assert not (out / "run.log").exists()


@pytest.fixture
def run_text(tmp_path, capsys):
    """Runs a program in one environment and gives what is said; the log is in tmp_path."""

    def run_text(text: str, bus: str, limit_s: int = 60) -> str:
        words = ["--environments", "1", "--limit-s", str(limit_s), "--bus", bus, "--out", str(tmp_path)]
        assert main(["run", "--profile", written(tmp_path, text), *words]) == 0
        return capsys.readouterr().out

    return run_text


@pytest.mark.parametrize("bus", ["none", "fd"])
def test_endless_loop_in_a_program_is_stopped_and_reported(bus, run_text):
    said = run_text("rForward 2\nwhile true\nwend\n", bus, limit_s=3)

    assert 'line 2: "while": expected rForward, rTurn or delay in the loop' in said


def test_program_that_goes_on_is_said_to_be_still_running(tmp_path, capsys):
    assert (
        main(["run", "--profile", str(ARTICLE), "--out", str(tmp_path), "--environments", "1", "--limit-s", "300"])
        == 0
    )

    told = capsys.readouterr().out
    assert "all food eaten in 88 s" in told
    assert "still running at the end of the run" in told


def test_missing_large_or_binary_program_is_refused(tmp_path):
    with pytest.raises(UsageError, match=r"no\.bas"):
        run(RunConfig(profile=str(tmp_path / "no.bas")))
    with pytest.raises(UsageError, match=r"own\.bas"):
        run(RunConfig(profile=written(tmp_path, "x = 1\n" * 3000)))
    with pytest.raises(UsageError, match=r"own\.bas is no behaviour: it is not text"):
        run(RunConfig(profile=written(tmp_path, "x = 1\0")))


@pytest.mark.parametrize(
    "other",
    [["--robot", "qemu"], ["--fast"], ["--robot-command", "true", "--bus", "fd"], ["--robots", "40"], ["--gdb"]],
)
def test_option_that_excludes_a_program_is_refused(other, capsys):
    assert main(["run", "--profile", str(ARTICLE), *other]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_replay_runs_the_recorded_program_not_the_changed_file(tmp_path, capsys):
    program = written(tmp_path, (EXAMPLES / "one_rule.bas").read_text())
    out = tmp_path / "out"
    words = ["--environments", "1", "--limit-s", "9", "--bus", "none", "--out", str(out)]
    assert main(["run", "--profile", program, *words]) == 0
    written(tmp_path, "rTurn 5\n")

    assert main(["replay", str(out / "run.log")]) == 0
    assert main(["replay", str(out / "run.log"), "--no-world"]) == 1
    assert main(["replay", str(out / "run.log"), "--profile", program]) == 1

    told = capsys.readouterr()
    assert "drives, no difference" in told.out
    assert f"{program} differs from own.bas (SHA-256 " in told.err


PRINTS = """n = 0
while n < 3
  rForward 1
  n += 1
  if n != 2 && true then print "step", n
wend
print "not complete";
"""


@pytest.mark.parametrize("bus", ["none", "fd"])
def test_run_prints_what_its_program_prints(bus, run_text):
    lines = run_text(PRINTS, bus).splitlines()

    assert [line for line in lines if line.startswith("printed")] == ["printed   step 1", "printed   step 3"]


@pytest.mark.parametrize("bus", ["none", "fd"])
def test_output_of_an_endlessly_printing_program_is_limited(bus, run_text):
    said = run_text("while true\nrForward 1\nfor i = 1 to 999\nprint i, i, i\nnext\nwend\n", bus, limit_s=5)

    lines = [line for line in said.splitlines() if line.startswith("printed")]
    assert lines[-1].split()[1] == lines[-1].split()[3]
    assert 300 < len(lines) < 500


@pytest.mark.parametrize("bus", ["none", "fd"])
def test_program_that_asks_for_distances_gets_them(bus, tmp_path, run_text):
    said = run_text("while rRange() > 6\nrForward 1\nwend\nprint rRange() > 2, rFeel() & 4\n", bus)

    assert "printed   1 4" in said
    assert main(["replay", str(tmp_path / "run.log")]) == 0


COURSE = {
    "wall": """
// Turns away from whatever is near.
MainLoop:
  feel = rFeel()
  if feel & 0%01110
    rTurn 10
  elseif feel == 0x1 || feel == 0x10
    rTurn 1
  else
    rForward 1
  endif
goto MainLoop
""",
    "bounce": """
bounces = 0
repeat
  while !rBumper() && rRange(0) > 5
    rForward 1
  wend
  bounces += 1
  print "bounce"; bounces
  rTurn 120 + random(60)
until bounces == 3
""",
    "search": """
turned = 0
for i = 1 to 360
  if rLook() == Green then break
  if i % 2 != 0 then continue
  rTurn 2
  turned += 2
next
print "turned", turned
""",
}
"""Programs in the manner of a first course: goto, repeat, break, the operators of C, print, distances."""


@pytest.mark.parametrize("name", COURSE)
def test_program_in_the_manner_of_a_course_runs(name, run_text):
    assert "expected" not in run_text(COURSE[name], "none")
