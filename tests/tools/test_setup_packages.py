"""tools/setup and Debian's packages, with stand-ins for the programs that install them."""

import os
import re
import shutil
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from tests.tools.setup_tree import INSTALLERS, STAND_IN, Tree


@pytest.fixture
def tree(tmp_path: Path) -> Tree:
    return Tree(tmp_path)


def test_what_cannot_be_installed_is_named_with_the_command(tree: Tree) -> None:
    for name in ("bash", "cat", "dirname", "env", "flock", "mkdir", "readlink", "rm"):
        (tree.bin / name).symlink_to(str(shutil.which(name)))
    for name in ("cmake", *INSTALLERS):
        (tree.bin / name).unlink()
    done, _ = tree.setup(path=str(tree.bin))
    assert done.returncode != 0
    assert "apt-get install gcc cmake\n" in done.stderr


def test_packages_alone_are_installed_without_a_venv_or_a_build(tree: Tree) -> None:
    done, calls = tree.setup("--packages", "c")
    assert (done.returncode, set(calls) - {"python3"}) == (0, set())  # python3 is asked whether it can make a venv
    assert not (tree.folder / ".venv").exists()


def test_packages_alone_that_cannot_be_installed_are_named(tree: Tree) -> None:
    for name in ("bash", "cat", "dirname", "env", "flock", "mkdir", "readlink", "rm"):
        (tree.bin / name).symlink_to(str(shutil.which(name)))
    for name in ("cmake", *INSTALLERS):
        (tree.bin / name).unlink()
    done, _ = tree.setup("--packages", "c", path=str(tree.bin))
    assert done.returncode != 0
    assert "apt-get install gcc cmake\n" in done.stderr


def test_packages_whose_installation_was_killed_are_installed_by_the_next_call(tree: Tree) -> None:
    for name in ("bash", "cat", "dirname", "env", "flock", "mkdir", "mktemp", "readlink", "rm", "sed", "cp"):
        (tree.bin / name).symlink_to(str(shutil.which(name)))
    gcc = tree.bin / "gcc"
    half = f'[[ $* != *install* || -e "{gcc}" ]] || {{ cp "$0" "{gcc}"; kill -9 "$PPID"; }}'
    for name, does in {"sudo": 'exec "$@"', "apt-get": half, "apt-cache": "echo gcc", "dpkg": ""}.items():
        (tree.bin / name).write_text(f"{STAND_IN}{does}\n")
        (tree.bin / name).chmod(0o755)

    ended = [tree.setup("--packages", "c", path=str(tree.bin)) for _ in range(3)]

    assert [done.returncode for done, _ in ended] == [-9, 0, 0]
    assert [calls.count("apt-get") for _, calls in ended] == [2, 2, 0]
    assert [done.stderr for done, _ in ended[1:]] == ["octet: installing gcc with apt-get\n", ""]


def test_a_set_up_that_is_somebody_elses_is_said_in_a_line_with_whose_it_is(tree: Tree) -> None:
    with TemporaryDirectory() as place:  # whose path, unlike tmp_path's, is open to others
        folder = Path(shutil.copytree(tree.folder / "tools", Path(place) / "tools")).parent
        (folder / "build").mkdir()
        (folder / "build/setup.lock").touch(mode=0o444)
        folder.chmod(0o755)
        nobody = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups") if os.geteuid() == 0 else ()
        done = subprocess.run([*nobody, folder / "tools/setup"], capture_output=True, text=True, check=False)

    said = r"octet: cannot write to \S+, which is \w+'s: call as that user, or get a clone of your own\n"
    assert (done.returncode, done.stdout) == (1, "")
    assert re.fullmatch(said, done.stderr)
