"""The one module about operating systems.

Interfaces to C code: parsed once and cached; available even if the cache cannot be written.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

import cffi
import pytest

from host_sim.base import c_interface as module
from host_sim.base.c_interface import c_interface
from host_sim.cli import run_watch_command
from host_sim.cli.run_options import RunOptions
from tests.runs.support import octet_process

ROOT = Path(__file__).resolve().parents[2]
ROOM = "host_sim/base/system.py"
ASKS = re.compile(
    r"sys\.platform|os\.name\b|import platform|platform\.system|hasattr\((os|signal|socket),"
    r"|_WIN32|__APPLE__|__linux__"
)
OF_POSIX = re.compile(
    r"import (fcntl|resource)|os\.(O_DIRECTORY|O_NOFOLLOW|O_NONBLOCK|geteuid|fchmod|fchown)"
    r"|signal\.(SIGHUP|SIGALRM|setitimer|pthread_sigmask)"
)
OUTSIDE = ("host_sim/lab/campaign/", "host_sim/lab/grade/", "host_sim/transport/cable.py")
"""They harm or limit robot processes, and so run only where those are supported."""

WITHOUT = """
import asyncio, builtins, os, signal, socket, sys
import asyncio.unix_events, pathlib, runpy, shutil, subprocess, tempfile
for name in ("fcntl", "resource", "termios", "pty", "tty", "grp", "pwd"):
    sys.modules[name] = None
sys.modules["msvcrt"] = type(sys)("msvcrt")
sys.modules["msvcrt"].LK_NBLCK, sys.modules["msvcrt"].locking = 0, lambda *_: None
for where, names in (
    (signal, "SIGHUP SIGKILL SIGUSR1 SIGUSR2 SIGALRM SIGPIPE SIGSTOP SIGCONT SIGCHLD pthread_sigmask setitimer"),
    (os, "fork geteuid getuid killpg fchmod fchown O_DIRECTORY O_NOFOLLOW O_NONBLOCK O_CLOEXEC set_blocking"),
    (socket, "AF_UNIX AF_CAN SOCK_SEQPACKET MSG_DONTWAIT"),
):
    for name in names.split():
        if hasattr(where, name):
            delattr(where, name)
sys.platform = "win32"
sys.argv = ["octet", *sys.argv[1:]]
runpy.run_module("host_sim", run_name="__main__")
"""
"""Runs octet on a Python that lacks what Python lacks on Windows."""


def sources() -> dict[str, str]:
    folders = (ROOT / name for name in ("host_sim", "octet_robot", "firmware", "hal"))
    paths = (path for folder in folders for path in folder.rglob("*") if path.suffix in {".py", ".c", ".h"})
    names = {path.relative_to(ROOT).as_posix(): path for path in paths}
    return {name: path.read_text() for name, path in names.items() if name != ROOM}


def test_only_system_py_asks_for_the_operating_system():
    assert len(sources()) > 500
    assert [name for name, text in sources().items() if ASKS.search(text)] == []


def test_only_listed_files_need_what_windows_lacks():
    assert [name for name, text in sources().items() if OF_POSIX.search(text) and not name.startswith(OUTSIDE)] == []


@pytest.mark.parametrize("line", ['if sys.platform == "win32":', "#ifdef _WIN32", 'hasattr(os, "fork")'])
def test_query_of_the_operating_system_is_detected(line):
    assert ASKS.search(line)


def test_run_without_what_windows_lacks_gives_the_same_log(tmp_path):
    words = ("run", "--environments", "1", "--limit-s", "20", "--quiet", "--memory", tmp_path / "robot.mem", "--out")
    octet_process(*words[:-3], "--out", tmp_path / "here").check_returncode()

    command = [sys.executable, "-c", WITHOUT, *words, tmp_path / "there"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)

    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    one, other = (json.loads((tmp_path / it / "summary.json").read_text()) for it in ("here", "there"))
    assert one["log_sha256"] == other["log_sha256"]


def test_bus_is_refused_without_robot_processes():
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT, "run", "--bus", "fd"], cwd=ROOT, capture_output=True, text=True, check=False
    )

    assert done.returncode == 2
    assert done.stderr == "octet: on this system a robot can only run in this process, not on fd: use --bus none\n"


@pytest.mark.parametrize(("has_processes", "bus"), [(True, "fd"), (False, "none")])
def test_watched_robot_runs_in_process_where_robot_processes_are_missing(monkeypatch, has_processes, bus):
    monkeypatch.setattr(run_watch_command, "HAS_ROBOT_PROCESSES", has_processes)

    assert run_watch_command._watched(RunOptions()).bus == bus


DECLARATIONS = "struct pair { int left, right; };"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "FOLDER", tmp_path / "cffi")
    c_interface.cache_clear()
    yield tmp_path / "cffi"
    c_interface.cache_clear()


@pytest.mark.usefixtures("folder")
def test_cached_c_interface_is_not_parsed_again(monkeypatch):
    c_interface(DECLARATIONS)
    c_interface.cache_clear()
    monkeypatch.setattr(cffi, "FFI", None)

    assert c_interface(DECLARATIONS).sizeof("struct pair") == 8


def test_other_declarations_get_their_own_cache_file(folder):
    c_interface(DECLARATIONS)

    assert c_interface("struct pair { char left, right; };").sizeof("struct pair") == 2
    assert len(list(folder.glob("*.py"))) == 2


@pytest.mark.parametrize("left", [b"", b"\0" * 100, b"ffi = 1 +", b"raise KeyError"])
def test_damaged_cache_of_a_c_interface_is_rewritten(folder, left):
    c_interface(DECLARATIONS)
    (kept,) = folder.glob("*.py")
    whole = kept.read_bytes()
    kept.write_bytes(left)  # as a power failure leaves it
    c_interface.cache_clear()

    assert c_interface(DECLARATIONS).sizeof("struct pair") == 8
    assert kept.read_bytes() == whole


def test_unwritable_cache_of_a_c_interface_is_ignored(folder):
    folder.touch()  # no folder can be made here

    assert c_interface(DECLARATIONS).sizeof("struct pair") == 8
