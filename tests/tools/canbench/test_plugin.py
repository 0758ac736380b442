"""The pytest plug-in: its options and markers, what a failure says, and its distribution."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES, PROJECT = ROOT / "examples", ROOT / "tools" / "pytest_canbench"
MOTOR_INI = (EXAMPLES / "motor" / "pytest.ini").read_text().replace("motor.", f"{EXAMPLES}/motor/motor.")


def run_pytest(folder, *words, plugin=("-p", "tools.pytest_canbench.plugin"), path=ROOT):
    environment = {**os.environ, "PYTHONPATH": str(path), "PYTEST_ADDOPTS": ""}
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-q", *plugin, *map(str, words)]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def test_only_the_test_with_faults_shows_the_bug_of_the_motor(tmp_path):
    done = run_pytest(tmp_path, EXAMPLES / "motor", "--can-shrink")

    assert done.returncode == 1
    assert "1 failed, 3 passed" in done.stdout
    assert re.findall(r"^FAILED .*::(\w+)", done.stdout, re.M) == ["test_motor_stops_when_every_set_point_is_damaged"]
    assert "31 faults by 1000 ms: corrupt@20-50/to" in done.stdout
    assert re.search(r"^ +990 ms from 200#\w+ STATUS crc=\d+ counter=\d+ speed=\d+ refused=31$", done.stdout, re.M)


@pytest.mark.parametrize(("example", "tests"), [("heater", 3), ("robot", 2)])
def test_example_passes(tmp_path, example, tests):
    done = run_pytest(tmp_path, EXAMPLES / example)

    assert done.returncode == 0, done.stdout
    assert f"{tests} passed" in done.stdout


FINDING = """
import pytest

@pytest.mark.can_faults("drop:20%/to", "duplicate:20%/to", "corrupt:20%/to")
def test_that_none_is_refused(can_bench):
    can_bench.run(ms=600)
    assert can_bench["STATUS.refused"] == 0
"""


def test_shrinking_finds_the_fewest_faults(tmp_path):
    (tmp_path / "pytest.ini").write_text(MOTOR_INI)
    (tmp_path / "test_finding.py").write_text(FINDING)

    done = run_pytest(tmp_path, "--can-shrink", "--can-seed", 3)

    assert re.search(r"-+ can_bench, seed 3 -+\n(\d{2}) faults by 600 ms", done.stdout)
    assert re.search(r"-+ can_bench, fewest faults -+\ncorrupt@\d+/to\n1 faults", done.stdout), done.stdout


def test_unusable_message_of_a_dbc_file_causes_a_warning(tmp_path):
    (tmp_path / "motor.dbc").write_text((EXAMPLES / "motor" / "motor.dbc").read_text() + "BO_ 768 LONG: 12 HOST\n")
    (tmp_path / "pytest.ini").write_text(MOTOR_INI)
    (tmp_path / "test_it.py").write_text("def test_it(can_bench):\n    can_bench.run(ms=10)\n")

    done = run_pytest(tmp_path, "--can-dbc", "motor.dbc")

    assert done.returncode == 0
    assert re.search(r"PytestWarning: .*motor.dbc: these messages cannot be used: LONG: it has 12 bytes", done.stdout)


WRONG = """
import pytest

def test_it(can_bench):
    can_bench.run(ms=10)

@pytest.mark.can_faults("nonsense")
def test_faults(can_bench):
    pass
"""


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "can_bench needs --can-dbc FILE.dbc, the bus, as a DBC file"),
        (("--can-dbc", "x.dbc"), "can_bench needs --can-device DEVICE"),
        (("--can-dbc", "x.dbc", "--can-device", "x.so"), "cannot read .*x.dbc: No such file or directory"),
        (("-c", "motor.ini", "--can-device", "x.so"), "cannot load .*x.so"),
        (("-c", "motor.ini", "--can-seed", "one"), "--can-seed is a number, not 'one'"),
        (("-c", "motor.ini", "--can-bus", "no", "--can-device", "true"), "cannot open the bus no"),
        (("-c", "motor.ini", "-k", "faults"), "'nonsense' is not a fault|there is no fault 'nonsense'"),
    ],
)
def test_mistake_is_reported_in_one_line(tmp_path, words, message):
    (tmp_path / "motor.ini").write_text(MOTOR_INI)
    (tmp_path / "test_wrong.py").write_text(WRONG)

    done = run_pytest(tmp_path, "test_wrong.py", *words)

    assert done.returncode == 1
    assert "Traceback" not in done.stdout + done.stderr
    assert re.search(rf"^({message})", done.stdout, re.M), done.stdout


def test_installed_plugin_works_without_octet(tmp_path):
    site, elsewhere, project = tmp_path / "site", tmp_path / "elsewhere", tmp_path / "tools" / "pytest_canbench"
    elsewhere.mkdir()
    for folder in (PROJECT, *(ROOT / "host_sim" / name for name in ("base", "transport"))):
        shutil.copytree(folder, tmp_path / folder.relative_to(ROOT))  # building leaves files beside the sources
    offline = ("--no-index", "--no-deps", "--no-build-isolation", "--disable-pip-version-check")
    install = [sys.executable, "-m", "pip", "install", "-q", *offline, "--target", site, project]
    subprocess.run(install, check=True, cwd=elsewhere)
    (elsewhere / "conftest.py").write_text(
        "import sys\n\ndef pytest_unconfigure():\n"
        "    print('of Octet:', *(name for name in sys.modules if name.startswith('host_sim')))\n"
    )
    (elsewhere / "test_it.py").write_text((EXAMPLES / "motor" / "test_motor.py").read_text())
    (elsewhere / "pytest.ini").write_text(MOTOR_INI)

    done = run_pytest(elsewhere, plugin=(), path=site)

    assert "1 failed, 3 passed" in done.stdout, done.stdout + done.stderr
    assert done.stdout.splitlines()[-1].strip() == "of Octet:"
