"""The commands in the documents work."""

import contextlib
import os
import pty
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.runs.support import BUSY_HOST, octet

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/*.md")])
BLOCK = re.compile(r"^```(\S+)(?: (\S+))?\n(.*?)^```$", re.DOTALL | re.MULTILINE)
NEW = "tools/octet new mine.c"
# These start the test run itself, or come before it.
NOT_FROM_HERE = ("tools/test", "tools/prove", "git clone")


def blocks(kind: str | None) -> dict[str, list[str]]:
    """The lines of each `sh` block with this mark, by its page and its number there."""
    found = {}
    for path in PAGES:
        texts = [text for word, mark, text in BLOCK.findall(path.read_text()) if (word, mark or None) == ("sh", kind)]
        for number, text in enumerate(texts, 1):
            lines = [line for line in text.splitlines() if line.strip() and not line.startswith(NOT_FROM_HERE)]
            found |= {f"{path.name} {number}": lines} if lines else {}
    return found


def commands(kind: str) -> list[str]:
    """The lines of all these blocks."""
    return list(dict.fromkeys(line for lines in blocks(kind).values() for line in lines))


def run(line: str, folder: Path) -> subprocess.CompletedProcess:
    """A line as a reader types it, in a folder like the project's. In real time, a busy host is no fault."""
    line = line.replace("--real-time", shlex.join(("--real-time", *BUSY_HOST)))
    return subprocess.run(line, shell=True, cwd=folder, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def first_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The output folder of the README's first command."""
    out = tmp_path_factory.mktemp("out")
    assert octet("run", "--bus", "none", "--quiet", "--out", out).returncode == 0
    return out


@pytest.fixture
def folder(tmp_path: Path, first_run: Path) -> Path:
    """The project's folder after its first run."""
    for entry in ROOT.iterdir():
        if entry.name != "out":
            (tmp_path / entry.name).symlink_to(entry)
    shutil.copytree(first_run, tmp_path / "out")
    return tmp_path


@pytest.mark.parametrize("lines", blocks(None).values(), ids=blocks(None))
def test_commands_of_each_block_succeed(lines, folder):
    if NEW not in lines and any("mine.c" in line for line in lines):
        assert run(NEW, folder).returncode == 0, "its page begins with this line"
    done = {line: run(line, folder) for line in lines}

    assert {line: (it.returncode, it.stderr) for line, it in done.items() if it.returncode} == {}


def test_documents_have_command_blocks():
    assert len(blocks(None)) >= 8


@pytest.mark.parametrize("line", commands("until-stopped"))
def test_until_stopped_commands_run_on_and_end_cleanly_on_ctrl_c(line, folder):
    ours, theirs = pty.openpty()
    terminal = {**os.environ, "TERM": "xterm"}  # a test machine may have none
    free_port = " --port 0" if "watch" in line and "--terminal" not in line else ""  # another test run may watch too
    process = subprocess.Popen(
        f"exec {line}{free_port}", shell=True, cwd=folder, env=terminal, stdin=theirs, stdout=theirs, stderr=theirs
    )
    os.close(theirs)

    first = b""
    while all(said.startswith(b"octet: ") for said in first.splitlines()):  # tools/setup may have to wait for another
        first += os.read(ours, 1024)
    time.sleep(2)
    goes_on = process.poll() is None
    process.send_signal(signal.SIGINT)

    assert goes_on
    with contextlib.suppress(OSError):  # the far end of a pty is closed when the process has ended
        while os.read(ours, 65536):
            pass
    assert process.wait() in (0, 130)
    os.close(ours)


@pytest.mark.parametrize("line", commands("needs-hardware"))
def test_hardware_commands_name_the_missing_device(line, folder):
    done = run(line, folder)

    assert done.returncode in (1, 2)
    assert "usage:" not in done.stderr
    assert any(word in done.stderr for word in re.split(r"[\s:?&=']+", line) if word)


def test_custom_body_is_built_and_prints_what_its_page_says(folder):
    page = (ROOT / "docs/porting.md").read_text()
    (printed,) = re.findall(r"^```text\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)

    *built, ran = [run(line, folder) for line in commands("with-my-body")]

    assert [(it.returncode, it.stderr) for it in built] == [(0, "")] * 2
    assert (ran.returncode, ran.stdout) == (0, printed)


PYTHON_BLOCK = re.compile(
    r"^```python\n(.*?)^```$(?:\n\nIt prints:\n\n```text\n(.*?)^```$)?", re.DOTALL | re.MULTILINE
)
CASES = [
    pytest.param(*found.groups(), id=f"{page.name} block {number}")
    for page in sorted([ROOT / "README.md", *ROOT.glob("docs/*.md")])
    for number, found in enumerate(PYTHON_BLOCK.finditer(page.read_text()), 1)
]


COMMAND = r"^```sh\n\.venv/bin/python -m (examples\.\S+)\n```\n\nIt prints:\n\n"
PROGRAM = re.compile(COMMAND + r"```text\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def run_block(code: str, folder: Path) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run(
        [sys.executable, "-c", code], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )


def test_documents_have_python_blocks():
    assert len(CASES) >= 5


@pytest.mark.parametrize(("code", "prints"), CASES)
def test_python_block_runs_and_prints_what_the_page_says(code, prints, tmp_path):
    done = run_block(code, tmp_path)

    assert (done.returncode, done.stderr) == (0, "")
    assert prints is None or done.stdout == prints


@pytest.mark.parametrize(("module", "prints"), PROGRAM.findall((ROOT / "docs/python.md").read_text()))
def test_example_prints_what_the_page_says(module, prints, tmp_path):
    done = run_block(f"import runpy; runpy.run_module({module!r}, run_name='__main__')", tmp_path)

    assert (done.returncode, done.stdout) == (0, prints)


def test_failing_python_block_is_detected(tmp_path):
    assert run_block("import host_sim.nothing", tmp_path).returncode != 0
