"""No test is skipped in silence: the gate in tests/conftest.py, and that it bites."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

CONFTEST = Path(__file__).resolve().parents[1] / "conftest.py"
SKIPS = {
    "in a test": "import pytest\ndef test_it():\n    pytest.skip('bus: there is none')\n",
    "in a fixture": (
        "import pytest\n@pytest.fixture\ndef bus():\n    pytest.skip('bus: there is none')\n"
        "def test_it(bus):\n    pass\n"
    ),
    "of a whole file": "import pytest\npytest.skip('bus: there is none', allow_module_level=True)\n",
    "by a mark": "import pytest\n@pytest.mark.skip(reason='bus: there is none')\ndef test_it():\n    pass\n",
}
PASSES = "def test_it():\n    pass\n"


def run_pytest(folder: Path, test: str, *options: str) -> subprocess.CompletedProcess[str]:
    shutil.copy(CONFTEST, folder)
    (folder / "test_one.py").write_text(test)
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", f"--rootdir={folder}", *options, "."]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60, check=False)


@pytest.mark.parametrize("test", SKIPS.values(), ids=SKIPS.keys())
def test_a_skip_fails_the_run_and_is_named(test, tmp_path):
    done = run_pytest(tmp_path, test)

    assert done.returncode != 0
    assert "there is none" in done.stdout


@pytest.mark.parametrize("test", SKIPS.values(), ids=SKIPS.keys())
def test_a_skip_that_the_caller_allowed_by_name_does_not_fail_the_run(test, tmp_path):
    done = run_pytest(tmp_path, test, "--allow-missing=bus")

    assert "failed" not in done.stdout
    assert "error" not in done.stdout


def test_allowing_one_name_allows_no_other(tmp_path):
    assert run_pytest(tmp_path, SKIPS["in a test"], "--allow-missing=browser").returncode != 0


def test_a_run_without_a_skip_passes(tmp_path):
    assert run_pytest(tmp_path, PASSES).returncode == 0
