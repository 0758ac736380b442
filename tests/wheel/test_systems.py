"""The wheels of all systems: what can be run here gives the same bytes, and the rest is for whom it says to be."""

from pathlib import Path

from tests.wheel.systems import HERE, ROOT, rows

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


def test_a_wheel_and_the_page_give_the_bytes_of_the_checkout(wheel: Path):
    """The other systems are tried by hand, with the same function: compiling for them takes a quarter of an hour."""
    here = [line for line in TABLE.splitlines() if line.startswith((HERE, "wasm"))]
    assert rows(wheel.parent, ["1", "2", "3"]) == [line.replace("20 of 20", "3 of 3") for line in here]


def test_a_run_that_differs_is_noticed(monkeypatch, tmp_path):
    monkeypatch.setattr("tests.wheel.systems.of_page", lambda seeds, _: ["0" * 64] * len(seeds))

    assert rows(tmp_path, ["1"]) == ["wasm                      0 of 1 equal"]
