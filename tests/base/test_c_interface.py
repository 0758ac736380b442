"""Interfaces to C code: read once, kept, and had all the same where nothing can be kept."""

import cffi
import pytest

from host_sim.base import c_interface as module
from host_sim.base.c_interface import c_interface

DECLARATIONS = "struct pair { int left, right; };"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "FOLDER", tmp_path / "cffi")
    c_interface.cache_clear()
    yield tmp_path / "cffi"
    c_interface.cache_clear()


@pytest.mark.usefixtures("folder")
def test_what_was_read_is_not_read_again(monkeypatch):
    c_interface(DECLARATIONS)
    c_interface.cache_clear()
    monkeypatch.setattr(cffi, "FFI", None)

    assert c_interface(DECLARATIONS).sizeof("struct pair") == 8


def test_other_declarations_are_others(folder):
    c_interface(DECLARATIONS)

    assert c_interface("struct pair { char left, right; };").sizeof("struct pair") == 2
    assert len(list(folder.glob("*.py"))) == 2


@pytest.mark.parametrize("left", [b"", b"\0" * 100, b"ffi = 1 +", b"raise KeyError"])
def test_a_damaged_copy_is_made_anew(folder, left):
    c_interface(DECLARATIONS)
    (kept,) = folder.glob("*.py")
    whole = kept.read_bytes()
    kept.write_bytes(left)  # as a loss of power leaves it
    c_interface.cache_clear()

    assert c_interface(DECLARATIONS).sizeof("struct pair") == 8
    assert kept.read_bytes() == whole


def test_where_nothing_can_be_kept_all_goes_on(folder):
    folder.touch()  # no folder can be made here

    assert c_interface(DECLARATIONS).sizeof("struct pair") == 8
