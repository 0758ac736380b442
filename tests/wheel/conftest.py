"""The wheel for Linux on x86-64, as tools/wheels builds it, in an environment that knows nothing of the checkout."""

import fcntl
import os
import subprocess
import sys
import venv
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LIBRARIES = (".venv/lib/python*/site-packages", "build/export", "build/study", "build/cluster", "build/classroom")


@pytest.fixture(scope="session")
def wheel(tmp_path_factory) -> Path:
    own = tmp_path_factory.getbasetemp()
    out = (own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / "wheelhouse"
    with (ROOT / "build/wheels.lock").open("w") as lock:  # the first worker builds it for all
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not out.exists():
            subprocess.run([ROOT / "tools/wheels", "--out", out, "linux-x86_64"], check=True)
    (built,) = out.iterdir()
    return built


@pytest.fixture(scope="session")
def environment(wheel, tmp_path_factory) -> Path:
    """A virtual environment with the wheel; the libraries of others are those that are installed for the tests."""
    folder = tmp_path_factory.mktemp("installed") / "venv"
    venv.create(folder, symlinks=True)
    pip = (sys.executable, "-m", "pip", "--disable-pip-version-check", "--python", folder, "install")
    subprocess.run([*pip, "--quiet", "--no-deps", "--no-index", wheel], check=True)
    (packages,) = folder.glob("lib/python*/site-packages")
    places = (path for pattern in LIBRARIES for path in ROOT.glob(pattern))
    (packages / "libraries.pth").write_text("".join(f"{path}\n" for path in places))
    return folder


@pytest.fixture
def octet(environment, tmp_path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs the command of the wheel, in a folder of its own."""

    def call(*words: object, **others: object) -> subprocess.CompletedProcess[str]:
        command = [environment / "bin" / "octet", *map(str, words)]
        how = {"cwd": tmp_path, "capture_output": True, "text": True, "timeout": 300, **others}
        return subprocess.run(command, check=False, **how)

    return call
