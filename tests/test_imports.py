"""The floors of host_sim, as pyproject.toml has them: an import that goes up is found."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

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


def test_every_import_goes_down(project):
    done = lint(project)

    assert done.returncode == 0, done.stdout


UPWARD = [
    ("host_sim.world", "host_sim.protocol"),
    ("host_sim.protocol", "host_sim.world"),
    ("host_sim.transport", "host_sim.client"),
    ("host_sim.transport", "host_sim.faults"),
    ("host_sim.faults", "host_sim.client"),
    ("host_sim.client", "host_sim.faults"),
    ("host_sim.sim", "host_sim.view"),
    ("host_sim.view", "host_sim.recording"),
    ("host_sim.recording", "host_sim.cli"),
    ("host_sim.live", "host_sim.report"),
    ("host_sim.bench", "host_sim.cli"),
]


def test_imports_that_go_up_or_across_are_all_found(project):
    for importer, imported in UPWARD:
        plant(project, importer, imported)

    done = lint(project)

    assert done.returncode != 0
    assert [arrow for arrow in UPWARD if "{}.planted -> {}".format(*arrow) not in done.stdout] == []


def test_a_package_without_a_floor_is_found(project):
    plant(project, "host_sim.attic", "host_sim.errors")
    (project / "host_sim/attic/__init__.py").touch()

    done = lint(project)

    assert done.returncode != 0
    assert "attic" in done.stdout + done.stderr


def test_an_exception_that_is_no_longer_needed_is_found(project):
    config = project / "pyproject.toml"
    arrow = '"host_sim.errors -> host_sim.cli.main"'
    text = config.read_text()
    config.write_text(text.replace("ignore_imports = [", f"ignore_imports = [{arrow}, "))
    assert arrow in config.read_text()

    assert lint(project).returncode != 0


def test_a_run_in_this_process_imports_nothing_that_only_others_need():
    script = "import sys, host_sim.sim.make; print(*{'aiohttp', 'can', 'cantools', 'PIL'} & set(sys.modules))"

    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True)

    assert done.stdout.split() == []
