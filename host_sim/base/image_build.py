"""Flash images of a board built in a folder of their own, so that the usual ones stay as they are."""

import os
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path

from host_sim.base.errors import OctetError
from host_sim.base.paths import ROOT
from host_sim.base.system import lock_at_once

_OTHER_S, _LOOK_S = 300.0, 0.1


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Keeps other processes from building in a folder meanwhile.

    Args:
        folder: Has the name of its board.

    Raises:
        OctetError: Another process still has it after 5 minutes.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with folder.with_suffix(".lock").open("w") as lock:
        _wait_for(lock.fileno(), folder.name)
        yield


def _wait_for(lock: int, board: str) -> None:
    end = time.monotonic() + _OTHER_S
    while True:
        try:
            return lock_at_once(lock)
        except BlockingIOError:
            if time.monotonic() > end:
                told = f"another octet still builds an image of {board}: try again when it has ended"
                raise OctetError(told) from None
        time.sleep(_LOOK_S)


def build_image(
    board: str, folder: Path, *settings: str, target: str, root: Path = ROOT
) -> subprocess.CompletedProcess[str]:
    """Configures and builds, with what the compiler and CMake print as text.

    Args:
        board: Its preset of CMake.
        folder: Where to build.
        settings: Of CMake, such as `-DOCTET_NODE=2`.
        target: What to build there.
        root: The checkout.

    Returns:
        The command that failed, or else the last one.
    """
    cache = folder / "CMakeCache.txt"
    newest_s = max((path.stat().st_mtime for path in (root / "tools/cmake").glob("*.cmake")), default=0.0)
    if cache.exists() and cache.stat().st_mtime < newest_s:
        shutil.rmtree(folder)  # CMake takes nothing new from a toolchain into a folder that it has configured
    configure = ["cmake", "--preset", board, "-B", os.fspath(folder), *settings]
    done = subprocess.run(configure, cwd=root, capture_output=True, text=True, check=False)
    if done.returncode:
        return done
    build = ["cmake", "--build", os.fspath(folder), "--target", target]
    return subprocess.run(build, cwd=root, capture_output=True, text=True, check=False)


def complaints(build: subprocess.CompletedProcess[str]) -> str:
    """What CMake, compiler and linker say in a build that failed, without the steps and commands of ninja."""
    lines = (build.stdout + build.stderr).splitlines()
    told = (line for before, line in pairwise(["", *lines]) if not before.startswith("FAILED: "))  # a command
    return "\n".join(line for line in told if not line.startswith(("[", "FAILED: ", "ninja: ")))
