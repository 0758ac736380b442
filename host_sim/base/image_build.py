"""Flash images of a board built in a folder of their own, so that the usual ones stay as they are."""

import os
import shutil
import subprocess
from pathlib import Path

from host_sim.base.paths import ROOT


def build_image(
    board: str, folder: Path, *settings: str, target: str = "all", root: Path = ROOT
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
