"""Worlds that a person writes: read as they are meant, and a mistake is named with its line."""

import re
from pathlib import Path

import pytest

from host_sim.base.errors import UsageError
from host_sim.world.geometry import Bar, Pose
from host_sim.world.layouts import World, WrittenLayout
from host_sim.world.worlds import content_of, world_from, world_of
from tests.world.clearances import is_fair

DOCS = Path(__file__).resolve().parents[2] / "docs"

FULL = """\
# A comment.
size = [3000, 2000]
start = [300, 300, 90]  # looks down
food = [
  [2700, 300],  # far [away]
  [1500, 1000],
]
bars = [[1000, 0, 1000, 1400], [2000, 600, 2000, 2000]]
"""


def read(folder: Path, text: str) -> World:
    path = folder / "my.toml"
    path.write_text(text)
    return world_of(str(path))


def test_a_file_is_read_as_it_is_meant(tmp_path):
    world = read(tmp_path, FULL)

    layout = world.generate(1, 1)
    assert (world.name, world.params.width_mm, world.params.height_mm) == ("my.toml", 3000.0, 2000.0)
    assert layout.bars == (Bar((1000.0, 0.0), (1000.0, 1400.0)), Bar((2000.0, 600.0), (2000.0, 2000.0)))
    assert layout.food == ((2700.0, 300.0), (1500.0, 1000.0))
    assert layout.start == pytest.approx(Pose(300.0, 300.0, 1.5707963))


def test_all_environments_have_the_same_layout(tmp_path):
    world = read(tmp_path, FULL)

    assert world.generate(1, 1) == world.generate(2, 7)


def test_a_start_that_is_left_out_is_drawn_for_each_environment_and_fair(tmp_path):
    world = read(tmp_path, re.sub("start.*", "", FULL))

    layouts = [world.generate(1, number) for number in range(1, 30)]
    assert len({layout.start for layout in layouts}) == len(layouts)
    assert all(is_fair(layout, world.params) for layout in layouts)


def test_a_world_can_be_written_out_and_made_again(tmp_path):
    world = read(tmp_path, FULL)
    assert isinstance(world.draw, WrittenLayout)

    assert world_from(content_of(world.draw, world.params), "my.toml") == world


def test_the_example_in_the_documents_is_the_file_beside_them():
    text = (DOCS / "worlds/two_walls.toml").read_text()

    assert f"```toml\n{text}```" in (DOCS / "worlds.md").read_text()


@pytest.mark.parametrize(
    ("text", "line", "meant"),
    [
        ("size = [3000", 1, "this is not TOML"),
        ("food = [[500, 500]]\nfood = []", 2, "this is not TOML"),
        ("\n\nsize = [", 3, "this is not TOML"),
        ("", 1, "a world needs food"),
        ("# c\nfood = []", 2, "a world needs food"),
        ("food = [[500, 500]]\nbar = []", 2, "there is no 'bar': did you mean 'bars'?"),
        ("food = [[500, 500]]\n[wall]", 2, "there is no 'wall': a world has size, start, food, bars"),
        ("food = [[500, 500]]\nsize = 3", 2, "size must be [width, height]: 2 numbers"),
        ("food = 3", 1, "food must be a list of at most 20"),
        ("food = [3]", 1, "food 1 must be [x, y]: 2 numbers"),
        ("food = [\n  [500, 500], # [one]\n  [1, true],\n]", 3, "food 2 must be [x, y]: 2 numbers"),
        ("food = [\n[500, 500],\n[5000, 3]]", 3, "food 2: [5000, 3] is outside of the arena, whose size is [4000"),
        ("food = [[500, 500]]\nbars = [\n[9, 9, 99, 99],\n[3, 4, 3, 5]]", 4, "bar 2 must be at least 40 mm long"),
        (
            "food = [\n[500, 500],\n[3000, 500]]\nbars = [[2000, 0, 2000, 2900]]",
            3,
            "food 2 cannot be reached from food 1",
        ),
    ],
)
def test_a_mistake_is_named_with_its_line_and_what_was_meant(tmp_path, text, line, meant):
    with pytest.raises(UsageError) as raised:
        read(tmp_path, text)

    assert str(raised.value).startswith(f"{tmp_path}/my.toml:{line}: {meant}")


@pytest.mark.parametrize("content", [b"\xff\xfe", b"x = " + b"[" * 100_000, b"\0"])
def test_what_is_no_text_for_people_is_refused(tmp_path, content):
    (tmp_path / "my.toml").write_bytes(content)

    with pytest.raises(UsageError, match=r"my\.toml"):
        world_of(str(tmp_path / "my.toml"))


def test_a_missing_file_is_said():
    with pytest.raises(UsageError, match=r"there is no file nowhere\.toml"):
        world_of("nowhere.toml")
