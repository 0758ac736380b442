"""A behaviour in a C file of its user. The judges are gcc, nm, gcc's sanitizers, and the behaviour `article`."""

import json
import os
import re
import shlex
import subprocess
from collections import Counter
from contextlib import closing
from pathlib import Path
from types import SimpleNamespace

import pytest

from host_sim.api import RunConfig, UsageError, run
from host_sim.base.errors import BrainError, RefusedError
from host_sim.base.paths import ROOT
from host_sim.base.toml_file import parse_toml
from host_sim.cli.main import main
from host_sim.client.commands import handshake, start
from host_sim.client.connection import Connection
from host_sim.client.frame_log import NoLog
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import OWN_PROFILE
from host_sim.report.laboratory import laboratory
from host_sim.sim import own_brain
from host_sim.sim.in_process_link import InProcessLink
from host_sim.sim.world_record import Source, WorldRecord
from tests.runs.support import unpacked

TEMPLATE = ROOT / "host_sim/program/own/mine.c"
WRONG = parse_toml((Path(__file__).parent / "wrong_brains.toml").read_text())
BEGIN = """\
#include "octet_brain.h"

bool own_begin(struct brain *brain)
{
    (void)brain;
    return true;
}
"""
NEXT = """
struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    (void)brain, (void)config, (void)senses;
"""
STEP = "return step(REASON_WANDER, 12);\n}\n"
LEARNED = bytes([0, 1, 2, 0, 1, 0, 2, 1])
TOOLS = own_brain._tools()
SHORT = ["--environments", "1", "--limit-s", "20"]


def source(code: str = "", top: str = "") -> str:
    return f"{top}\n{BEGIN}{NEXT}{code}\n{STEP}"


def written(folder: Path, text: str, name: str = "mine.c") -> str:
    (folder / name).write_text(text)
    return str(folder / name)


@pytest.fixture(params=["checked", "fast"])
def how(request):
    return {"fast": request.param == "fast"}


def frames(path: Path) -> list[str]:
    return [line.split()[2] for line in path.read_text().splitlines()]


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_log_of_the_template_equals_that_of_article_except_for_the_profile(seed, tmp_path, capsys):
    mine = tmp_path / "mine.c"
    assert main(["new", str(mine)]) == 0
    words = ["--seed", str(seed), "--environments", "3", "--limit-s", "300", "--bus", "none", "--quiet"]
    assert main(["run", *words, "--profile", str(mine), "--out", str(tmp_path / "own")]) == 0
    assert main(["run", *words, "--out", str(tmp_path / "article")]) == 0
    assert "wrote" in capsys.readouterr().out

    pairs = zip(frames(tmp_path / "own/run.log"), frames(tmp_path / "article/run.log"), strict=True)
    different = Counter(own[:3] for own, article in pairs if own != article)

    assert set(different) == {"021", "141", "6A1", "7C1"}  # START and its answer, HEARTBEAT, HEALTH
    assert different["021"] == different["141"] == 1


def test_template_behaves_like_article_with_the_kit_body():
    config = {"seed": 2, "environments": 2, "body": "kit", "limit_s": 120.0}

    own, article = run(RunConfig(profile=str(TEMPLATE), **config)), run(RunConfig(**config))

    assert own.memories == article.memories
    assert [it.ticks for it in own.episodes] == [it.ticks for it in article.episodes]


def test_template_has_at_most_60_lines():
    assert len(TEMPLATE.read_text().splitlines()) <= 60


def test_own_behaviours_do_the_same_in_process_and_in_processes():
    config = {"seed": 3, "environments": 1, "robots": 3, "profile": str(TEMPLATE)}

    assert run(RunConfig(**config)).log_sha256 == run(RunConfig(fast=True, **config)).log_sha256


@pytest.mark.parametrize("name", WRONG)
def test_wrong_behaviour_is_reported_with_its_line(name, tmp_path, capfd):
    wrong = WRONG[name]
    text = source(wrong["code"], wrong.get("top", ""))
    file = written(tmp_path, text)
    memory = tmp_path / "eight.mem"
    memory.write_bytes(LEARNED)
    line = 1 + text[: text.index("/*!*/")].count("\n")
    lines = range(line - 1, line + 2) if wrong.get("near") else [line]

    words = [*SHORT, "--quiet", "--bus", "fd", "--memory", str(memory)]
    code = main(["run", "--profile", file, *words, "--out", str(tmp_path / "out")])

    said = capfd.readouterr().err
    assert code in (1, 2)
    wanted = [wrong["says"]] if isinstance(wrong["says"], str) else wrong["says"]
    assert any(it in said for it in wanted), said
    assert any(f"mine.c:{it}:" in said for it in lines), said
    assert "octet_brain.h:" not in said
    assert memory.read_bytes() == LEARNED
    assert code == 2 or "at tick 0, 0.00 s, with nothing in the way, no food seen" in said


def test_wrong_behaviours_number_at_least_forty():
    assert len(WRONG) >= 40


def test_mistake_is_reported_with_its_tick_and_senses(tmp_path, how):
    code = "if (pattern_of(senses->feel) == 2) { volatile int z = 0; z = 1 / z; }"
    file = written(tmp_path, source(code), "at tick 7, mine.c")

    told = r"at tick 7, mine\.c:\d+:\d+: a division by zero, at tick (\d\d+), .* with front blocked"
    with pytest.raises(BrainError, match=told) as mistake:
        run(RunConfig(profile=file, limit_s=60.0, **how))
    assert mistake.value.tick == int(re.search(told, str(mistake.value))[1])


FILES = {
    "not_c": ("this is no C at all\n", "error: unknown type name 'this'"),
    "empty": ("", "has no function own_begin"),
    "no_brain": (BEGIN, "has no function own_next"),
    "two_brains": (f"{source()}{NEXT}{STEP}", "error: redefinition of 'own_next'"),
    "another_type": ("int own_next(void);\n", "error: conflicting types for 'own_next'"),
    "a_static_one": (source().replace("\nstruct action own", "\nstatic struct action own"), "own_next"),
    "bytes": ("\0\1\2", "is no behaviour"),
    "a_main_of_its_own": (f"{source()}int main(void);\nint main(void)\n{{\n return 0;\n}}\n", "main"),
}


@pytest.mark.parametrize("name", FILES)
def test_file_that_is_no_behaviour_is_refused(name, tmp_path, capfd):
    text, says = FILES[name]
    file = written(tmp_path, text)

    assert main(["run", "--profile", file, *SHORT, "--out", str(tmp_path / "out")]) == 2

    assert says in capfd.readouterr().err
    assert not (tmp_path / "out/run.log").exists()


def test_missing_file_is_refused(tmp_path, capsys):
    assert main(["run", "--profile", str(tmp_path / "no.c"), *SHORT]) == 2
    assert "no.c: tools/octet new" in capsys.readouterr().err


def test_behaviour_file_may_begin_with_a_byte_order_mark(tmp_path):
    file = written(tmp_path, f"\ufeff{source()}")

    assert run(RunConfig(profile=file, limit_s=1.0, environments=1)).log_sha256


@pytest.mark.parametrize("name", ["a name with spaces.c", '"quoted".c', "-o.c", "ein Gehirn \u00e4.c"])
def test_behaviour_file_may_have_any_name(name, tmp_path, capfd, monkeypatch):
    monkeypatch.chdir(tmp_path)
    written(tmp_path, source("brain->frozen = true;"), name)

    assert main(["run", f"--profile={name}", *SHORT, "--quiet", "--bus", "fd"]) == 1

    assert re.search(
        rf"^octet: {re.escape(name)}:\d+: brain->frozen was changed", capfd.readouterr().err, re.MULTILINE
    )


def test_compiler_warnings_are_shown_once_as_they_are(tmp_path, capfd):
    text = source("int unused;")
    file = written(tmp_path, text)

    run(RunConfig(profile=file, limit_s=1.0, environments=1))

    said = capfd.readouterr().err
    assert (
        f"mine.c:{1 + text[: text.index('int unused')].count(chr(10))}:5: warning: unused variable 'unused'" in said
    )
    assert "robot" not in said.partition("warning")[0]


@pytest.mark.parametrize("code", ["volatile int *volatile p = 0;\n*p = 1;", "while (senses)\n    brain->own[0]++;"])
def test_mistake_in_process_ends_the_run_and_not_the_process(code, tmp_path, capsys):
    file = written(tmp_path, source(code))

    assert main(["run", "--profile", file, "--fast", *SHORT, "--quiet", "--out", str(tmp_path / "out")]) == 1

    assert "at tick 0" in capsys.readouterr().err
    assert main(["run", "--profile", str(TEMPLATE), "--fast", *SHORT, "--quiet", "--out", str(tmp_path / "out")]) == 0


def test_notes_are_printed_at_the_end_of_the_run(tmp_path, capsys):
    file = written(tmp_path, source('note("pattern", pattern_of(senses->feel));'))

    assert main(["run", "--profile", file, *SHORT, "--bus", "fd", "--out", str(tmp_path / "out")]) == 0

    out = capsys.readouterr().out
    assert "printed   pattern 0\n" in out
    assert 0 < out.count("printed") < 500


def test_cache_of_compiled_behaviours_is_bounded_and_used(tmp_path, monkeypatch):
    monkeypatch.setattr(own_brain, "_CACHE", tmp_path / "cache")
    monkeypatch.setattr(own_brain, "_CACHED_MAX", 2)
    monkeypatch.setattr(own_brain, "_BUSY_S", 0.0)
    texts = [source(f"brain->own[0] = {i};").encode() for i in range(4)]

    folders = [own_brain.compiled(text, "mine.c").folder for text in texts]

    assert [folder.exists() for folder in folders] == [False, False, True, True]
    monkeypatch.setattr(own_brain, "_compile", None)  # nothing is compiled again
    assert own_brain.compiled(texts[3], "mine.c").library.exists()


@pytest.mark.parametrize(("age_min", "stays"), [(30, True), (90, False)])
def test_compiled_behaviour_is_kept_for_an_hour(tmp_path, monkeypatch, age_min, stays):
    monkeypatch.setattr(own_brain, "_CACHE", tmp_path / "cache")
    monkeypatch.setattr(own_brain, "_CACHED_MAX", 1)
    folder = own_brain.compiled(source("brain->own[0] = 1;").encode(), "mine.c").folder
    used_s = folder.stat().st_mtime - 60 * age_min
    os.utime(folder, (used_s, used_s))

    own_brain.compiled(source("brain->own[0] = 2;").encode(), "mine.c")

    assert folder.exists() == stays


def test_robot_without_the_file_refuses_the_own_profile():
    link = InProcessLink(1)
    with closing(NoLog()) as log:
        client = RobotClient(Connection(link, "none", link.status, answers_at_once=True), Protocol(1), log)
        handshake(client, 1.0)

        with pytest.raises(RefusedError):
            start(client, Session(1, OWN_PROFILE))


@pytest.mark.parametrize(
    "words",
    [
        ["--robot", "qemu", "--fast"],
        ["--robot-command", "true", "--bus", "fd"],
        ["--fast", "--bus", "fd"],
    ],
)
def test_option_that_excludes_an_own_behaviour_is_refused(words, capsys):
    assert main(["run", "--profile", str(TEMPLATE), *words]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_fast_option_is_refused_without_an_own_behaviour():
    with pytest.raises(UsageError, match="--fast is for a behaviour of your own"):
        RunConfig(fast=True)


def test_new_command_prints_a_command_that_can_be_copied(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)

    assert main(["new", "mein Roboter.c"]) == 0

    command = shlex.split(capsys.readouterr().out.partition("tools/run ")[2])
    assert main(["run", *command, *SHORT, "--quiet"]) == 0


def test_missing_compiler_is_named_in_one_line(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(own_brain, "_CACHE", tmp_path / "cache")
    monkeypatch.setattr(own_brain, "_tools", lambda: {**TOOLS, "compiler": "/nowhere/cc"})

    assert main(["run", "--profile", str(TEMPLATE), *SHORT]) == 2

    assert capsys.readouterr().err == (
        "octet: cannot start the compiler /nowhere/cc: No such file or directory; run tools/setup\n"
    )


def test_new_command_overwrites_no_file(tmp_path, capsys):
    file = written(tmp_path, "int x;\n")

    assert main(["new", file]) == 2
    assert main(["new", str(tmp_path / "mine.py")]) == 2
    assert main(["new", str(tmp_path / "no/mine.c")]) == 2

    assert Path(file).read_text() == "int x;\n"
    assert capsys.readouterr().err.count("\n") == 3


def run_of_one_s_own(folder: Path) -> tuple[str, str]:
    """A log, and the file of the behaviour that its robot had."""
    file = written(folder, TEMPLATE.read_text())
    words = ["--environments", "1", "--limit-s", "20", "--quiet", "--out", str(folder / "out")]
    assert main(["run", "--profile", file, *words]) == 0
    return str(folder / "out/run.log"), file


def test_log_of_an_own_behaviour_asks_for_its_file_and_is_replayed_with_it(tmp_path, capsys):
    log, file = run_of_one_s_own(tmp_path)

    assert main(["replay", log]) == 2
    assert f"had mine.c (SHA-256 {sha256(TEMPLATE)[:12]}): add --profile and this file" in capsys.readouterr().err
    assert main(["replay", log, "--no-world"]) == 2
    assert "had a behaviour of its own: add --profile MINE.C, its file" in capsys.readouterr().err
    assert main(["replay", log, "--profile", file]) == 0
    assert not capsys.readouterr().err


def test_replay_says_that_the_file_has_changed_and_names_the_debugger(tmp_path, capsys):
    log, file = run_of_one_s_own(tmp_path)
    Path(file).write_text(TEMPLATE.read_text().replace("set[STEP_MM]", "set[STEP_MM] / 2"))

    assert main(["replay", log, "--profile", file]) == 1

    told = capsys.readouterr()
    assert f"{file} differs from mine.c (SHA-256 " in told.err
    assert f" debug {log} --profile {file} --node 1 --at " in told.out


def test_recorded_behaviour_is_compiled_only_on_request(tmp_path, monkeypatch):
    log, file = run_of_one_s_own(tmp_path)
    Path(file).unlink()
    monkeypatch.setattr(own_brain, "_CACHE", tmp_path / "cache")

    for words in (["replay", log], ["replay", log, "--html", str(tmp_path / "a.html")], ["picture", log]):
        main(words)
    assert not (tmp_path / "cache").exists()
    assert main(["replay", log, "--compile"]) == 0
    assert list((tmp_path / "cache").glob("source-*/mine.c"))


def sha256(path: Path) -> str:
    """As sha256sum, which nobody here wrote, says."""
    return subprocess.run(["sha256sum", path], capture_output=True, text=True, check=True).stdout.split()[0]


def test_outputs_of_a_run_have_the_name_and_sha256_of_the_file(tmp_path):
    log, _ = run_of_one_s_own(tmp_path)
    out = Path(log).parent

    own = {"name": "mine.c", "sha256": sha256(TEMPLATE)}
    assert json.loads((out / "summary.json").read_text())["own"] == own
    assert json.loads((out / "run.world.json").read_text())["own"] == {**own, "source": TEMPLATE.read_text()}
    page = unpacked((out / "replay.html").read_text())
    assert f"seed 1, mine.c (SHA-256 {own['sha256'][:12]})" in page


def test_page_says_why_what_if_cannot_run_an_own_behaviour():
    record = WorldRecord(1, 1, 50, own=Source("mine.c", b"int x;"))
    track = SimpleNamespace(node=1)

    told = laboratory(Path("run.log"), SimpleNamespace(tracks=[track]), record, [])

    assert told["why"].startswith("What if? runs the firmware's own brain, and the brain of this run was mine.c (SHA")
