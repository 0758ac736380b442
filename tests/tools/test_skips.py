"""No test is skipped in silence: the gate in tests/conftest.py, and that it bites."""

import shutil
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

CONFTEST = Path(__file__).resolve().parents[1] / "conftest.py"
SKIPS = {
    "in a test": "import pytest\ndef test_it():\n    pytest.skip('bus: there is none')\n",
    "in a fixture": (
        "import pytest\n@pytest.fixture\ndef bus():\n    pytest.skip('bus: there is none')\n"
        "def test_it(bus):\n    pass\n"
    ),
    "by a mark": "import pytest\n@pytest.mark.skip(reason='bus: there is none')\ndef test_it():\n    pass\n",
}
SKIPPED_FILE = "import pytest\npytest.skip('bus: there is none', allow_module_level=True)\n"
EXPECTED_FAILURES = {
    "run": "import pytest\n@pytest.mark.xfail(reason='bus: known')\ndef test_it():\n    assert 0\n",
    "not run": "import pytest\n@pytest.mark.xfail(run=False, reason='bus: known')\ndef test_it():\n    pass\n",
    "at run time": "import pytest\ndef test_it():\n    pytest.xfail('bus: known')\n",
}
PASSES = "def test_it():\n    pass\n"


def run_pytest(folder: Path, tests: Iterable[str], *options: str) -> subprocess.CompletedProcess[str]:
    """Runs tests, each in a file of its own."""
    shutil.copy(CONFTEST, folder)
    for number, test in enumerate(tests):
        (folder / f"test_{number}.py").write_text(test)
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", f"--rootdir={folder}", *options, "."]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_each_skip_fails_the_run_and_is_named(tmp_path):
    done = run_pytest(tmp_path, [*SKIPS.values(), PASSES])

    assert done.returncode != 0
    assert done.stdout.splitlines()[-1].startswith("1 failed, 1 passed, 2 errors in")
    assert done.stdout.count("skipped, which counts as failed: bus: there is none") >= len(SKIPS)


def test_a_whole_file_that_is_skipped_fails_the_run_and_is_named(tmp_path):
    done = run_pytest(tmp_path, [SKIPPED_FILE])

    assert done.returncode != 0
    assert "skipped, which counts as failed: bus: there is none" in done.stdout


def test_a_skip_that_the_caller_allowed_by_name_does_not_fail_the_run(tmp_path):
    done = run_pytest(tmp_path, [*SKIPS.values(), SKIPPED_FILE, PASSES], "--allow-missing=bus")

    assert done.returncode == 0
    assert f"1 passed, {len(SKIPS) + 1} skipped" in done.stdout


def test_allowing_one_name_allows_no_other(tmp_path):
    assert run_pytest(tmp_path, [SKIPS["in a test"]], "--allow-missing=browser").returncode != 0


def test_an_expected_failure_fails_the_run_whatever_the_caller_allowed(tmp_path):
    done = run_pytest(tmp_path, [*EXPECTED_FAILURES.values(), PASSES], "--allow-missing=bus")

    assert done.stdout.splitlines()[-1].startswith("2 failed, 1 passed, 1 error in")
    assert "skipped, which counts as failed: xfail: " in done.stdout
