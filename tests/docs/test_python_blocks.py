"""The Python in the documents runs as it stands there, and prints what the documents say."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```python\n(.*?)^```$(?:\n\nIt prints:\n\n```text\n(.*?)^```$)?", re.DOTALL | re.MULTILINE)
CASES = [
    pytest.param(*found.groups(), id=f"{page.name} block {number}")
    for page in sorted([ROOT / "README.md", *ROOT.glob("docs/*.md")])
    for number, found in enumerate(BLOCK.finditer(page.read_text()), 1)
]


COMMAND = r"^```sh\n\.venv/bin/python -m (examples\.\S+)\n```\n\nIt prints:\n\n"
PROGRAM = re.compile(COMMAND + r"```text\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def run(code: str, folder: Path) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run(
        [sys.executable, "-c", code], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )


def test_there_are_blocks():
    assert len(CASES) >= 5


@pytest.mark.parametrize(("code", "prints"), CASES)
def test_a_block_runs_and_prints_what_the_page_says(code, prints, tmp_path):
    done = run(code, tmp_path)

    assert (done.returncode, done.stderr) == (0, "")
    assert prints is None or done.stdout == prints


@pytest.mark.parametrize(("module", "prints"), PROGRAM.findall((ROOT / "docs/python.md").read_text()))
def test_an_example_prints_what_the_page_says(module, prints, tmp_path):
    done = run(f"import runpy; runpy.run_module({module!r}, run_name='__main__')", tmp_path)

    assert (done.returncode, done.stdout) == (0, prints)


def test_a_block_that_fails_is_noticed(tmp_path):
    assert run("import host_sim.nothing", tmp_path).returncode != 0
