"""tools/fresh without root: with stand-ins for the programs that make and enter a system."""

import os
import platform
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
HERE = platform.freedesktop_os_release()["VERSION_CODENAME"]
LISTS = f"""http://archive.test/debian/ {HERE} main
http://archive.test/debian/ {HERE} contrib
http://archive.test/debian/ {HERE}-updates main
http://archive.test/debian-security/ {HERE}-security main
http://other.test/tools {HERE}-tools main
"""
# debootstrap fails while there is a file beside the notes; a command fails if it has the word "fails".
STAND_INS = {
    "apt-config": "echo 'Acquire::Retries \"3\";'",
    "apt-get": 'cat "$LISTS"',
    "chroot": 'mkdir -p "$1/home/octet"',
    "debootstrap": 'mkdir -p "$5"/etc/{apt/apt.conf.d,ssl/certs,sudoers.d}; echo E: broken; [ ! -e "$CALLS.broken" ]',
    "git": "",
    "id": 'echo "${ID-0}"',
    "setpriv": 'shift 2; "$@"',
    "unshare": 'shift 5; if [ "$1" = bash ]; then [[ $6 != *fails* ]]; else "$@"; fi',
}


class Tree:
    """A copy of tools/fresh in a folder of its own; notes each call of a stand-in."""

    def __init__(self, tmp_path: Path) -> None:
        self.folder, self.bin, self.calls = (tmp_path / name for name in ("tree", "bin", "calls"))
        (self.folder / "tools").mkdir(parents=True)
        shutil.copy(ROOT / "tools/fresh", self.folder / "tools")
        (self.folder / "tools/setup").write_text("#!/bin/sh\n")
        (self.folder / "tools/setup").chmod(0o755)
        self.lists = tmp_path / "lists"
        self.lists.write_text(LISTS)
        self.bin.mkdir()
        for name, does in STAND_INS.items():
            (self.bin / name).write_text(f'#!/bin/bash\necho "{name} $*" >>"$CALLS"\n{does}\n')
            (self.bin / name).chmod(0o755)

    def fresh(self, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
        """Runs tools/fresh."""
        self.calls.write_text("")
        path = f"{self.bin}:{os.environ['PATH']}"
        env = {"PATH": path, "CALLS": str(self.calls), "LISTS": str(self.lists), **environment}
        command = [self.folder / "tools/fresh", *arguments]
        return subprocess.run(command, cwd="/", env=env, capture_output=True, text=True, check=False)

    def called(self, name: str) -> list[str]:
        """The calls of a stand-in, in the last run."""
        return [line for line in self.calls.read_text().splitlines() if line.startswith(f"{name} ")]


@pytest.fixture
def tree(tmp_path: Path) -> Tree:
    return Tree(tmp_path)


@pytest.mark.parametrize("word", ["-h", "--help"])
def test_help_needs_nothing(tree, word):
    done = tree.fresh(word, ID="1000")

    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("tools/fresh [--anew] SYSTEM [COMMAND...]")
    assert tree.calls.read_text() == ""


@pytest.mark.parametrize("arguments", [[], ["--anew"], ["jammy"], ["Trixie"], ["--new", "trixie"]])
def test_unsupported_system_is_answered_with_the_supported_ones(tree, arguments):
    done = tree.fresh(*arguments)

    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert "bookworm, trixie or sid" in line
    assert tree.calls.read_text() == ""


def test_call_without_root_names_the_sudo_command(tree):
    done = tree.fresh("trixie", ID="1000")

    assert (done.returncode, done.stderr) == (2, "fresh: making a system needs root: sudo tools/fresh trixie\n")
    assert not (tree.folder / "build").exists()


def test_machine_without_a_debian_archive_is_refused_with_advice(tree):
    tree.lists.write_text("http://archive.test/ubuntu noble main\n")

    done = tree.fresh("trixie")

    assert done.returncode == 2
    assert "try it on Debian" in done.stderr.splitlines()[-1]
    assert not tree.called("debootstrap")


@pytest.mark.parametrize(
    ("system", "sources"),
    [
        (
            "trixie",
            "deb http://archive.test/debian-security/ trixie-security main\n"
            "deb http://archive.test/debian/ trixie main\n"
            "deb http://archive.test/debian/ trixie-updates main\n",
        ),
        ("sid", "deb http://archive.test/debian/ sid main\n"),
    ],
)
def test_new_system_has_the_archives_of_this_machine(tree, system, sources):
    assert tree.fresh(system).returncode == 0

    assert (tree.folder / f"build/fresh/{system}/etc/apt/sources.list").read_text() == sources
    assert tree.called("debootstrap")[0].endswith(
        f" {system} {tree.folder}/build/fresh/{system}.new http://archive.test/debian/"
    )


def test_call_without_commands_runs_those_of_the_readme(tree):
    done = tree.fresh("trixie")

    assert [line.split(" took ")[0] for line in done.stderr.splitlines() if " took " in line] == [
        "fresh: trixie: tools/run",
        "fresh: trixie: tools/test",
    ]


def test_all_commands_run_and_the_failed_ones_are_named(tree):
    done = tree.fresh("trixie", "this fails", "this not")

    assert done.returncode == 1
    assert "fresh: trixie: this not took" in done.stderr
    assert done.stderr.splitlines()[-1] == "fresh: trixie: failed: this fails"


def test_incomplete_system_is_made_again_and_a_complete_one_is_kept(tree):
    broken = Path(f"{tree.calls}.broken")
    broken.touch()
    done = tree.fresh("trixie", "true")
    assert (done.returncode, done.stderr.splitlines()[-1][:38]) == (2, "fresh: cannot make trixie: E: broken; ")
    broken.unlink()

    assert tree.fresh("trixie", "true").returncode == 0
    assert len(tree.called("debootstrap")) == 1
    assert tree.fresh("trixie", "true").returncode == 0
    assert tree.called("debootstrap") == []
    assert tree.fresh("--anew", "trixie", "true").returncode == 0
    assert len(tree.called("debootstrap")) == 1
