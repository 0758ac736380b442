"""docs/bench.md: its device of thirty lines works, and its commands do what it says."""

import os
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/bench.md").read_text()
FILES = {
    name: textwrap.dedent(text)
    for name, text in re.findall(r"^ *```\w+ ([\w.]+\.\w+)\n(.*?)^ *```$", PAGE, re.DOTALL | re.MULTILINE)
}
(COMMANDS,) = re.findall(r"^```sh on-the-bench\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)


def run_pytest(folder, *words):
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTEST_ADDOPTS": ""}
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-p", "tools.pytest_canbench.plugin", *words]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


@pytest.fixture
def folder(tmp_path):
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def test_the_fan_of_the_page_passes_and_takes_thirty_lines(folder):
    written = "".join(text for name, text in FILES.items() if name != "fan.dbc")

    assert run_pytest(folder).returncode == 0
    assert sorted(FILES) == ["fan.c", "fan.dbc", "pytest.ini", "test_fan.py"]
    assert len([line for line in written.splitlines() if line]) <= 30


def test_a_fan_that_does_not_cool_fails(folder):
    (folder / "fan.c").write_text(FILES["fan.c"].replace("duty = 100;", ""))

    assert run_pytest(folder).returncode == 1


def test_the_commands_of_the_page_do_what_it_says():
    venv, pip, *tests = COMMANDS.splitlines()

    done = [run_pytest(ROOT, *line.split()[1:]) for line in tests]

    assert (venv, pip.split()[-1]) == ("python3 -m venv build/bench", "./tools/pytest_canbench")
    assert [it.returncode for it in done] == [0, 0, 1]
    assert (ROOT / pip.split()[-1] / "pyproject.toml").exists()


def test_every_option_and_method_that_the_page_names_exists():
    from tools.pytest_canbench.bench import Bench  # noqa: PLC0415 - what the page is about
    from tools.pytest_canbench.devices import ImageDevice  # noqa: PLC0415 - see above

    helped = run_pytest(ROOT, "--help").stdout
    options = re.findall(r"`(--can-[a-z]+)", PAGE)
    methods = re.findall(r"`(?:can_bench\.)?([a-z_]+)\(", PAGE.partition("of the fixture")[2])
    of_devices = re.findall(r"`device\.([a-z_]+)", PAGE)

    assert len(set(options)) == 7
    assert [option for option in options if option not in helped] == []
    assert [name for name in methods if not hasattr(Bench, name)] == []
    assert [name for name in of_devices if not hasattr(ImageDevice, name)] == []
