"""`run.world.json` gives back what was written, and takes no nonsense."""

import json

import pytest

from host_sim.base.errors import OctetError, UsageError
from host_sim.recording.world_file import read_world, world_path, write_world
from host_sim.sim.world_record import Begun, Edited, Refused, Source, WorldRecord
from host_sim.world.edits import Edit
from host_sim.world.geometry import Bar, Plant, SimParams
from host_sim.world.layouts import World
from host_sim.world.worlds import world_of

PLANT = Plant((500.0, 600.0), 80.0)
BAR = Bar((10.0, 20.0), (300.0, 40.0))
EDITS = [
    Edited(3, Edit("add_bar", **BAR._asdict())),
    Edited(3, Edit("move_bar", 6, **BAR._asdict())),
    Edited(4, Edit("remove_bar", 6)),
    Edited(9, Edit("move_food", 2, at=(1.0, 2.0))),
    Edited(9, Edit("lift")),
    Edited(12, Edit("put", at=(100.0, 200.0), heading=-3100)),
    Edited(13, Edit("plant", at=PLANT.at, radius=PLANT.radius_mm)),
    Edited(14, Edit("move_plant", 0, at=(900.0, 800.0))),
    Edited(14, Edit("grow_plant", 0, radius=120.0)),
    Edited(15, Edit("body", what="noise:10/1000", robot=1, seed=7)),
    Edited(16, Edit("remove_plant", 0)),
]


def record() -> WorldRecord:
    world = World("random", SimParams(front_extra_mm=0.25))
    return WorldRecord(
        1,
        5,
        30000,
        2,
        [Begun(1, 1, 0), Begun(1, 2, 7)],
        list(EDITS),
        [Refused(12, "plant@1s", "the robot stands there")],
        world,
        own=Source("mine.c", b"int x; /* \xff */\n"),
    )


def test_written_world_is_read_back(tmp_path):
    path = world_path(tmp_path / "run.log")
    write_world(record(), path)
    assert path.name == "run.world.json"
    assert read_world(path) == record()


def test_program_in_the_earlier_format_is_read_as_program_bas(tmp_path):
    path = tmp_path / "run.world.json"
    path.write_text(json.dumps({**GOOD, "program": "x = 1\n"}))

    assert read_world(path).own == Source("program.bas", b"x = 1\n")


@pytest.mark.parametrize("name", ["corridors", "small"])
def test_built_in_world_is_written_by_its_name(tmp_path, name):
    path = tmp_path / "run.world.json"
    write_world(WorldRecord(1, 5, 30000, world=world_of(name)), path)
    assert json.loads(path.read_text())["world"] == name
    assert read_world(path).world == world_of(name)


def test_custom_world_is_written_in_full(tmp_path):
    path, own = tmp_path / "run.world.json", tmp_path / "my.toml"
    own.write_text("start = [400, 400.5, 30]\nfood = [[500, 500]]\nbars = [[9, 9, 99, 99]]")
    world = world_of(str(own))
    write_world(WorldRecord(1, 5, 30000, world=world), path)
    own.unlink()
    assert read_world(path).world == world


def test_random_world_is_not_named(tmp_path):
    path = tmp_path / "run.world.json"
    write_world(WorldRecord(1, 5, 30000), path)
    assert "world" not in json.loads(path.read_text())


def test_file_without_front_extra_mm_has_five_equal_cones(tmp_path):
    path = tmp_path / "run.world.json"
    path.write_text(json.dumps(GOOD))
    assert read_world(path).world.params.front_extra_mm == 0.0


def test_dragging_between_two_ticks_records_only_the_last_place():
    dragged = WorldRecord(1, 5, 30000)
    for x in (1.0, 2.0, 3.0):
        dragged.add(Edited(5, Edit("move_food", 0, at=(x, 0.0))))
    dragged.add(Edited(5, Edit("move_food", 1, at=(9.0, 0.0))))
    dragged.add(Edited(6, Edit("move_food", 1, at=(10.0, 0.0))))
    places = [(edited.tick, edited.edit.id, edited.edit.at[0]) for edited in dragged.edits]
    assert places == [(5, 0, 3.0), (5, 1, 9.0), (6, 1, 10.0)]


def test_edits_after_the_last_tick_are_dropped_except_body_faults():
    kept = WorldRecord(1, 5, 30000)
    for edit in (
        Edit("add_bar", **BAR._asdict()),
        Edit("body", what="mirror"),
        Edit("plant", at=PLANT.at, radius=PLANT.radius_mm),
    ):
        kept.add(Edited(5, edit))
    kept.begin(Begun(1, 2, 5))
    assert kept.edits == [Edited(5, Edit("body", what="mirror"))]


def test_run_that_begins_anew_drops_body_faults():
    kept = WorldRecord(1, 5, 30000)
    kept.add(Edited(5, Edit("body", what="mirror")))
    kept.begin(Begun(2, 1, 5))
    assert kept.edits == []


def test_equal_edits_that_add_bars_are_all_kept():
    kept = WorldRecord(1, 5, 30000)
    kept.add(Edited(5, Edit("add_bar", **BAR._asdict())))
    kept.add(Edited(5, Edit("add_bar", **BAR._asdict())))
    assert len(kept.edits) == 2


GOOD = {"format": 1, "seed": 1, "of": 5, "limit_ticks": 9, "environments": [], "edits": []}


@pytest.mark.parametrize(
    "change",
    [
        {"format": 2},
        {"own": "int x;"},
        {"own": {"name": "../mine.c", "sha256": Source("", b"x").sha256, "source": "x"}},
        {"own": {"name": "mine.sh", "sha256": Source("", b"x").sha256, "source": "x"}},
        {"own": {"name": "mine.c", "sha256": Source("", b"y").sha256, "source": "x"}},
        {"own": {"name": "mine.c", "sha256": Source("", b"x").sha256}},
        {"seed": -1},
        {"seed": True},
        {"seed": 1.0},
        {"of": 0},
        {"limit_ticks": "9"},
        {"front_extra_mm": 1},
        {"front_extra_mm": -0.5},
        {"front_extra_mm": 1e9},
        {"world": "moon"},
        {"world": []},
        {"world": {"name": "my.toml"}},
        {"world": {"name": "my.toml", "food": [[1e308, 5]]}},
        {"body": None},
        {"body": {"base": ["kit"]}},
        {"environments": {}},
        {"environments": [1]},
        {"environments": [{"seed": 1, "number": 0, "first_tick": 0}]},
        {"environments": [{"seed": 1, "number": n, "first_tick": 9 - n} for n in (1, 2)]},
        {"refused": [1]},
        {"refused": [{"tick": 1, "what": "plant@1s"}]},
        {"refused": [{"tick": 1, "what": "plant@1s", "why": "x" * 1001}]},
        {"edits": [{"tick": 1, "do": "body", "what": "explode"}]},
        {"edits": [{"tick": 1, "do": "body", "what": 3}]},
        {"edits": [{"tick": 1, "do": "body", "what": "mirror", "seed": -1}]},
        {"edits": [{"tick": 1, "do": "plant", "at": [1, 2], "radius": 1000}]},
        {"edits": [{"tick": 1, "do": "dance"}]},
        {"edits": [{"do": "lift"}]},
        {"edits": [{"tick": 1, "do": "put", "at": [0, 0]}]},
        {"edits": [{"tick": 1, "do": "move_bar", "id": 1, "a": [0, 0], "b": [1e3, 0]}]},
    ],
)
def test_damaged_file_is_refused(tmp_path, change):
    path = tmp_path / "run.world.json"
    path.write_text(json.dumps({**GOOD, **change}))
    with pytest.raises(OctetError, match="not a world file"):
        read_world(path)


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b"\xff\xfe", b"[" * 100_000])
def test_file_without_a_json_object_is_refused(tmp_path, content):
    path = tmp_path / "run.world.json"
    path.write_bytes(content)
    with pytest.raises(OctetError, match="not a world file"):
        read_world(path)


def test_missing_file_is_reported(tmp_path):
    with pytest.raises(UsageError, match="cannot read"):
        read_world(tmp_path / "none.json")
