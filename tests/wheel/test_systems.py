"""The wheels of all systems: what can be run here gives the same bytes, and the rest is for whom it says to be."""

import fcntl
import subprocess
from pathlib import Path

from tests.wheel.systems import ROOT, rows

TABLE = """\
macosx_11_0_arm64         built, not run: Mach-O ARM64, wants /usr/lib/libSystem.B.dylib
macosx_11_0_x86_64        built, not run: Mach-O X86_64, wants /usr/lib/libSystem.B.dylib
manylinux_2_26_aarch64    20 of 20 equal
manylinux_2_26_x86_64     20 of 20 equal
musllinux_1_1_aarch64     built, not run: ELF AARCH64, wants libc.so
musllinux_1_1_x86_64      20 of 20 equal
win_amd64                 20 of 20 equal
wasm                      20 of 20 equal
"""


def test_the_page_has_the_table():
    assert f"```text\n{TABLE}```" in (ROOT / "docs/wheels.md").read_text()


def test_every_system_gives_the_same_bytes(tmp_path: Path):
    with (ROOT / "build/wheels.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        subprocess.run([ROOT / "tools/wheels", "--out", tmp_path], check=True)

    assert rows(tmp_path, ["1", "2", "3"]) == TABLE.replace("20 of 20", "3 of 3").splitlines()


def test_a_run_that_differs_is_noticed(monkeypatch, tmp_path):
    monkeypatch.setattr("tests.wheel.systems.of_page", lambda seeds, _: ["0" * 64] * len(seeds))

    assert rows(tmp_path, ["1"]) == ["wasm                      0 of 1 equal"]
