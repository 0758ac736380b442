"""The layers of host_sim, as pyproject.toml defines them: an import of a higher layer is found."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from host_sim.cli.main import main

ROOT = Path(__file__).resolve().parent.parent
LINT_IMPORTS = "from importlinter.cli import lint_imports_command; lint_imports_command()"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    shutil.copytree(ROOT / "host_sim", tmp_path / "host_sim", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    return tmp_path


def lint(project: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", LINT_IMPORTS, "--no-cache"]
    return subprocess.run(command, cwd=project, capture_output=True, text=True, check=False)


def plant(project: Path, importer: str, imported: str) -> None:
    path = project / importer.replace(".", "/")
    path.mkdir(exist_ok=True)
    with (path / "planted.py").open("a") as file:
        file.write(f"import {imported}\n")


def test_host_sim_imports_only_lower_layers(project):
    done = lint(project)

    assert done.returncode == 0, done.stdout


UPWARD = [
    ("host_sim.protocol", "host_sim.world"),
    ("host_sim.transport", "host_sim.client"),
    ("host_sim.transport", "host_sim.protocol"),
    ("host_sim.client", "host_sim.transport.rule"),
    ("host_sim.client", "host_sim.sim"),
    ("host_sim.sim", "host_sim.recording"),
    ("host_sim.recording", "host_sim.cli"),
    ("host_sim.live", "host_sim.report"),
    ("host_sim.cli", "host_sim.lab.study"),
    ("host_sim.live", "host_sim.lab.export"),
    ("host_sim.lab.export", "host_sim.lab.bench"),
    ("host_sim.lab.study", "host_sim.lab.campaign"),
]


def test_imports_that_go_up_or_across_are_found(project):
    for importer, imported in UPWARD:
        plant(project, importer, imported)

    done = lint(project)

    assert done.returncode != 0
    assert [arrow for arrow in UPWARD if "{}.planted -> {}".format(*arrow) not in done.stdout] == []


def test_package_without_a_layer_is_found(project):
    plant(project, "host_sim.attic", "host_sim.base.errors")
    (project / "host_sim/attic/__init__.py").touch()

    done = lint(project)

    assert done.returncode != 0
    assert "attic" in done.stdout + done.stderr


def test_unneeded_import_exception_is_found(project):
    config = project / "pyproject.toml"
    arrow = '"host_sim.base.errors -> host_sim.cli.main"'
    text = config.read_text()
    config.write_text(text.replace("ignore_imports = [", f"ignore_imports = [{arrow}, "))
    assert arrow in config.read_text()

    assert lint(project).returncode != 0


ELSEWHERE = {
    "PIL",
    "aiohttp",
    "asyncio",
    "can",
    "cantools",
    "concurrent",
    "difflib",
    "gymnasium",
    "host_sim.sim.qemu",
    "host_sim.transport.faulty_link",
    "host_sim.live.server",
    "host_sim.report",
    "host_sim.lab.study",
    "multiprocessing",
    "numpy",
    "pandas",
    "pyarrow",
    "pycparser",
    "rich",
    "subprocess",
    "tomllib",
}
"""Modules that only other runs and other commands need, or a run after its first tick."""


def loaded_at_the_first_tick(folder: Path, first: str = "") -> set[str]:
    """The modules of ELSEWHERE that a run in this process has loaded at its first tick."""
    module = "host_sim.lab.bench.first_tick"
    script = f"{first}\nimport runpy; runpy.run_module({module!r}, run_name='__main__', alter_sys=True)"
    command = [sys.executable, "-c", script, str(folder), *ELSEWHERE]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return set(done.stdout.split()[1:])


def test_in_process_run_loads_only_modules_that_it_needs(tmp_path):
    loaded_at_the_first_tick(tmp_path)  # the first run after a build parses C declarations, and caches them

    assert loaded_at_the_first_tick(tmp_path) == set()


def test_gate_finds_an_unneeded_import(tmp_path):
    assert loaded_at_the_first_tick(tmp_path, "import PIL, host_sim.report") == {"PIL", "host_sim.report"}


@pytest.mark.parametrize(("bus", "loads"), [("fd", False), ("socketcan:nowhere", True)])
def test_python_can_is_loaded_only_for_its_buses(tmp_path, bus, loads):
    words = ["run", "--bus", bus, "--limit-s", "1", "--environments", "1", "--quiet", "--out", str(tmp_path)]
    script = f"import sys, host_sim.cli.main as m; m.main({words}); print('can' in sys.modules)"

    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True)

    assert done.stdout.splitlines()[-1] == str(loads)


def test_only_the_command_that_is_called_is_loaded():
    script = "import sys, host_sim.cli.main as m; m.main(['dbc', '--node', '1']); print(*sys.modules)"

    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True)

    commands = {name for name in done.stdout.split() if name.endswith("_command")}
    assert commands == {"host_sim.cli.dbc_command"}


COMMANDS = sorted(
    "check-wiring" if name == "checkwiring" else name
    for path in ROOT.glob("host_sim/**/*_command.py")
    for name in path.stem.split("_")[:-1]
)


@pytest.mark.parametrize("name", COMMANDS)
def test_command_is_in_the_name_of_its_module(name, capsys):
    with pytest.raises(SystemExit):
        main([name, "--help"])

    assert capsys.readouterr().out.startswith(f"usage: tools/octet {name} ")
