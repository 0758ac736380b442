"""Libraries of C code that cannot be used: the run ends with a line that says why."""

import pytest

from host_sim.base.errors import OctetError
from host_sim.sim import native_loop
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.world import world_library

WORLD = world_library, world_library.world_library
LOOP = native_loop, native_loop.loaded


@pytest.fixture(params=[WORLD, LOOP], ids=["world", "loop"])
def module(request):
    """A module whose library is loaded anew, in this test and in the next one."""
    module, load = request.param
    load.cache_clear()
    yield module
    load.cache_clear()


def remove_library(module, monkeypatch, folder) -> None:
    monkeypatch.setattr(module, "LIBRARY", folder / module.LIBRARY.name)


def break_library(module, monkeypatch, folder) -> None:
    (folder / module.LIBRARY.name).write_text("no library")
    monkeypatch.setattr(module, "LIBRARY", folder / module.LIBRARY.name)


def change_header(module, monkeypatch, folder) -> None:
    other = folder / module.HEADERS[-1].name
    other.write_text(module.HEADERS[-1].read_text() + "/* newer */\n")
    monkeypatch.setattr(module, "HEADERS", (*module.HEADERS[:-1], other))


BROKEN = {
    remove_library: "is missing",
    break_library: "cannot be loaded",
    change_header: "was built from other sources",
}


@pytest.mark.parametrize(("damage", "reason"), BROKEN.items(), ids=lambda part: getattr(part, "__name__", ""))
def test_a_run_ends_with_one_line_that_says_why(module, tmp_path, monkeypatch, damage, reason):
    damage(module, monkeypatch, tmp_path)

    with pytest.raises(OctetError) as raised, make(RunConfig(environments=1, limit_s=1.0)) as simulation:
        list(simulation.run())

    assert str(raised.value).startswith(f"{module.LIBRARY.name} {reason}")
    assert str(raised.value).endswith("; build it with tools/setup")
    assert "\n" not in str(raised.value)
