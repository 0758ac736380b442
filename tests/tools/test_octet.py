"""The tools before anything is set up: a copy of the sources, the plain python3, and a stand-in for tools/setup."""

import ast
import os
import re
import shutil
import subprocess
import sys
from dataclasses import astuple
from pathlib import Path

import pytest

from host_sim.protocol import generated, words
from host_sim.transport.faulty_link import FAULTS
from host_sim.transport.rule import FAULT_NAMES
from tools.robot_words.model import read

ROOT = Path(__file__).resolve().parents[2]
PROTOCOL = ROOT / "hal" / "protocol"

STAGES = {
    "run": "run",
    "run --robot qemu": "qemu",
    "run --robot=qemu --seed 2": "qemu",
    "run --robot emulated --board blue_pill": "blue_pill emulator",
    "run --robot emulated --board pico": "pico",
    "page --pico octet.html": "page pico",
    "run --robot emulated --board pico --body pins": "pico emulator",
    "watch --robot=emulated": "feather_stm32f405 emulator",
    "watch --listen": "run classroom",
    "run --watch --listen=0.0.0.0 --robot qemu": "qemu classroom",
    "run --out=--listen": "run",
    "new mine.c": "run",
    "page octet.html": "page",
    "class": "page",
    "class --listen": "page classroom",
    "replay out/run.log": "run",
    "debug out/run.log --tick 7": "debug",
    "run --gdb": "debug",
    "run --gdb --robot qemu": "debug-images",
    "replay out/run.log --html run.html --what-if": "page",
    "export out/run.log --csv out/run.csv": "run",
    "export out/run.log --parquet out/run.parquet": "export",
    "campaign --html out/campaign.html": "run",
    "campaign --html out/campaign.html --links fd blue_pill": "images emulator",
    "compare article --robot emulated": "feather_stm32f405 emulator",
    "calibrate --robot emulated": "emulator blue_pill",
    "compare article": "run",
    "study studies/learned.toml": "study",
    "study studies/learned.toml --cluster tcp://host:8786": "study cluster",
}
"""What `tools/octet` sets up, by the words after it."""

WRONG = (
    "run --robot emulated --board nucleo",
    "run --board blue_pill",
    "run --robot qemu --bus socketcan:can0",
    "run --robot emulated --node 2",
    "run --robot external",
    "run --robot emulated --set colour=3",
    "run --robot qemu --change explode@20s",
    "run --robots 40 --robot qemu",
    "run --robots 40 --watch",
    "run --listen",
    "watch --listen --terminal",
    "watch --listen --port 99999",
    "page",
    "replay run.log --what-if",
    "campaign --links blue_pill",
    "export run.log --mf4 run.log",
    "dance",
)

HELP = (
    *("octet --help", "run --help", "bench --help", "bench -h", "octet study -h"),
    *("octet watch --listen --help", "octet page --help", "octet run --robot emulated --help"),
    *("coverage --help", "flash --help", "fresh --help", "generate --help", "legacy-fpu --help", "licences --help"),
    *("misra --help", "mutate --help", "prove --help", "requirements --help", "size --help", "test --help"),
    *("pins --help", "release --help", "rooms --help", "wheels --help", "with-vcan --help", "uf2 --help"),
)


@pytest.fixture(scope="module")
def sources(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sources as they come from git."""
    folder = tmp_path_factory.mktemp("bare") / "a tree"
    made = shutil.ignore_patterns("__pycache__", "generated.py", "generated.ts")
    for name in ("docs", "hal", "host_sim", "tools"):
        shutil.copytree(ROOT / name, folder / name, ignore=made)
    (folder / "out").mkdir()
    setup = folder / "tools/setup"
    setup.write_text('#!/bin/sh\necho sets up: "$@"\n')
    return folder


def call(folder: Path, words: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Runs a tool with a python3 that has only the standard library."""
    programs = folder.parent / "bin"
    programs.mkdir(exist_ok=True)
    python = programs / "python3"
    if not python.exists():
        python.write_text(f'#!/bin/sh\nexec {sys._base_executable} -S "$@"\n')
        python.chmod(0o755)
    name, *arguments = words.split()
    variables = {**os.environ, "PATH": f"{programs}:/usr/bin:/bin", "PYTHONDONTWRITEBYTECODE": "1", **environment}
    command = [folder / "tools" / name, *arguments]
    return subprocess.run(command, cwd=folder, env=variables, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("words", HELP)
def test_help_needs_no_set_up(words: str, sources: Path, tmp_path: Path) -> None:
    """Help does not even need tomllib, which Python has from 3.11 on."""
    (tmp_path / "tomllib.py").write_text('raise ModuleNotFoundError("tomllib")\n')
    done = call(sources, words, PYTHONPATH=str(tmp_path))
    assert (done.returncode, done.stderr) == (0, "")
    assert "sets up" not in done.stdout
    assert words.split(maxsplit=1)[0] in done.stdout


def test_help_is_tested_for_each_tool() -> None:
    tools = {path.name for path in (ROOT / "tools").iterdir() if path.is_file() and os.access(path, os.X_OK)}
    assert tools - {"setup"} == {words.split()[0] for words in HELP}


@pytest.mark.parametrize("words", WRONG)
def test_mistake_is_reported_before_anything_is_set_up(words: str, sources: Path) -> None:
    done = call(sources, f"octet {words}")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("octet: ")
    assert done.stderr.count("\n") == 1


@pytest.fixture
def with_python(sources: Path) -> Path:
    """The sources, with a stand-in for the venv's Python, which runs only tools/launch.py."""
    python = sources / ".venv/bin/python"
    python.parent.mkdir(parents=True, exist_ok=True)
    python.write_text('#!/bin/sh\n[ "$1" != -IS ] || exec python3 "$@"\necho "$@" $PYTHONDONTWRITEBYTECODE\n')
    python.chmod(0o755)
    return sources


@pytest.mark.parametrize("words", STAGES)
def test_octet_sets_up_what_the_options_need(words: str, with_python: Path) -> None:
    done = call(with_python, f"octet {words}")
    assert done.stdout.splitlines() == [f"sets up: {STAGES[words]}", f"-m host_sim {words}"], done.stderr


def test_bench_sets_up_what_the_tests_need(with_python: Path) -> None:
    assert call(with_python, "bench --json").stdout.splitlines() == [
        "sets up: tests web vcan",
        "-m host_sim.lab.bench --json",
    ]


def test_failed_setup_runs_no_command(with_python: Path, tmp_path: Path) -> None:
    folder = shutil.copytree(with_python, tmp_path / "tree")
    (folder / "tools/setup").write_text("#!/bin/sh\nexit 7\n")
    done = call(folder, "octet run")
    assert (done.returncode, done.stdout, done.stderr) == (7, "", "")


def test_outdated_python_is_refused_with_the_required_version(sources: Path, tmp_path: Path) -> None:
    source = (sources / "tools/launch.py").read_text()
    folder = shutil.copytree(sources, tmp_path / "tree")
    (folder / "tools/launch.py").write_text(source.replace("(3, 10)", "(4, 10)"))
    done = call(folder, "run --help")
    assert done.returncode == 1
    assert done.stderr.startswith("octet: python3 must be 4.10 or newer; here it is 3.")


def test_missing_python_is_reported_with_its_package(sources: Path, tmp_path: Path) -> None:
    for program in ("bash", "env", "dirname", "readlink"):
        (tmp_path / program).symlink_to(str(shutil.which(program)))
    done = call(sources, "run", PATH=str(tmp_path))
    assert done.returncode == 1
    assert done.stderr == "octet: python3 is missing. To install, as root: apt-get install python3\n"


def test_words_of_the_command_line_match_the_generated_ones() -> None:
    assert words.NODE_MAX == generated.NODE_MAX
    assert list(words.PROFILES) == list(generated.PROFILES)
    described = read(PROTOCOL / "octet.dbc", PROTOCOL / "robot.toml").parameters
    assert [(name, *it) for name, it in words.PARAMETERS.items()] == [astuple(it) for it in described]
    assert tuple(FAULTS) == FAULT_NAMES


def test_package_missing_from_the_venv_is_reported_in_one_line() -> None:
    without = "import runpy, sys; sys.modules['can'] = None; runpy.run_module('host_sim', run_name='__main__')"
    words = ("run", "--bus", "socketcan:nowhere")
    done = subprocess.run(
        [sys.executable, "-c", without, *words], capture_output=True, text=True, check=False, cwd=ROOT
    )

    assert done.returncode == 1
    assert done.stderr == "octet: can is missing from .venv: remove that folder and run the command again\n"


PYTHON = b"#!/usr/bin/env python3\n"
TOOLS = sorted(
    path.name for path in (ROOT / "tools").iterdir() if path.is_file() and path.read_bytes().startswith(PYTHON)
)


def programs(source: str) -> list[str]:
    """The program name of each argument parser of a source; empty for one without a name of its own."""
    calls = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Call)]
    parsers = [call for call in calls if ast.unparse(call.func) == "argparse.ArgumentParser"]
    names = [[ast.literal_eval(word.value) for word in call.keywords if word.arg == "prog"] for call in parsers]
    return [name for found in names for name in found or [""]]


BUILDS = re.compile(r'\[ROOT / "tools(/|" / ")(octet|run|setup|size)"')


def test_tests_do_not_rebuild_what_others_run_meanwhile():
    assert [path.name for path in (ROOT / "tests").rglob("test_*.py") if BUILDS.search(path.read_text())] == []


@pytest.mark.parametrize("text", ['"tools/run", *words]', '"tools" / "size"]'])
def test_line_of_a_test_that_builds_is_detected(text):
    assert BUILDS.search(f"[ROOT / {text}")


def test_parser_without_a_name_is_found():
    assert programs("argparse.ArgumentParser(description=__doc__)") == [""]


@pytest.mark.parametrize("name", TOOLS)
def test_usage_of_a_tool_begins_with_its_path(name):
    source = (ROOT / "tools" / name).read_text()

    assert set(programs(source)) <= {f"tools/{name}"}
