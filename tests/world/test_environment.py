"""Environments and worlds by name: drawn in C from Python's random numbers, fair, and turned the right way round.

Worlds that a person writes: read as they are meant, and a mistake is named with its line.
"""

import itertools
import math
import random
import re
from pathlib import Path

import numpy as np
import pytest

from host_sim.base.errors import UsageError
from host_sim.world.body import rolled
from host_sim.world.geometry import Bar, Pose, SimParams, ahead_of
from host_sim.world.layouts import Layout, NoRoomError, World, WrittenLayout, generate
from host_sim.world.names import WORLD_NAMES
from host_sim.world.world_library import world_library
from host_sim.world.worlds import content_of, world_from, world_of
from tests.world.golden_layouts import DIGESTS, WANTED, can_reach, clearances_mm, digest, is_fair, numbers, world

PARAMS = SimParams()


def room_mm(layout: Layout, *points: tuple[float, float]) -> list[float]:
    return [float(room) for room in clearances_mm(np.array(points), layout.bars, PARAMS)]


def test_faster_left_wheel_turns_right_and_right_turns_are_positive() -> None:
    assert rolled(Pose(0.0, 0.0, 0.0), left_mm=2.0, right_mm=1.0, track_mm=100.0).heading_rad == pytest.approx(0.01)


def test_heading_0_is_along_x_and_right_of_it_is_down_the_screen() -> None:
    pose = Pose(10.0, 20.0, 0.0)

    assert ahead_of(pose, 5.0) == pytest.approx((15.0, 20.0))
    assert ahead_of(pose, 5.0, math.pi / 2) == pytest.approx((10.0, 25.0))


def test_bearing_counts_from_the_heading() -> None:
    assert ahead_of(Pose(0.0, 0.0, math.pi / 2), 5.0, math.pi / 2) == pytest.approx((-5.0, 0.0))


@pytest.mark.parametrize(("seed", "number"), [(2, 1), (1, 2), (-1, 1), (11, 1), (1, 11)])
def test_environments_differ_with_the_seed_and_the_number(seed: int, number: int) -> None:
    assert generate(seed, number, PARAMS) != generate(1, 1, PARAMS)


def test_food_behind_obstacles_is_drawn_again() -> None:
    # Bars almost as long as the arena is high: most draws cut it in two.
    params = SimParams(bar_count=3, bar_length_mm=(2700.0, 2900.0))
    for seed in range(10):
        layout = generate(seed, 1, params)

        assert all(can_reach(layout, food, params) for food in layout.food)


def test_starts_face_all_four_quarters() -> None:
    headings = [generate(seed, 1, PARAMS).start.heading_rad for seed in range(100)]

    quarters = {math.floor(heading / (math.pi / 2)) for heading in headings}
    assert quarters == {-2, -1, 0, 1}


def test_world_without_room_is_refused_with_its_seed_and_number() -> None:
    with pytest.raises(ValueError, match="seed 5, number 3"):
        generate(5, 3, SimParams(width_mm=300.0, height_mm=300.0, bar_count=0))


@pytest.mark.parametrize("params", [SimParams(bar_count=65), SimParams(food_bands_mm=((0.0, 4000.0),) * 21)])
def test_too_many_obstacles_or_pieces_of_food_are_refused(params: SimParams) -> None:
    with pytest.raises(ValueError, match="at most 64 obstacles and 20 pieces of food"):
        generate(1, 1, params)


def test_robots_start_out_of_reach_of_each_other_and_of_obstacles() -> None:
    layout = generate(3, 1, PARAMS, robots=20)
    reach_mm = PARAMS.body_radius_mm + PARAMS.sensor_reach_mm

    apart = [math.dist(a[:2], b[:2]) for a, b in itertools.combinations(layout.starts, 2)]
    assert min(apart) >= reach_mm + PARAMS.body_radius_mm
    assert min(room_mm(layout, *(start[:2] for start in layout.starts))) >= reach_mm


def test_too_many_robots_are_refused_with_how_many_fit() -> None:
    small = SimParams(width_mm=1500.0, height_mm=1500.0, bar_count=0, food_bands_mm=((0.0, 1500.0),))

    with pytest.raises(NoRoomError, match=r"there is room for \d+ robots in environment 1") as raised:
        generate(1, 1, small, robots=60)

    assert len(generate(1, 1, small, robots=raised.value.fitting).starts) == raised.value.fitting


def drawn(text: str, count: int) -> list[float]:
    ffi, library = world_library()
    draws = ffi.new("struct draws *")
    library.draws_seed(draws, text.encode())
    return [library.draws_next(draws) for _ in range(count)]


def drawn_by_python(text: str, count: int) -> list[float]:
    draws = random.Random(text)
    return [draws.random() for _ in range(count)]


def test_first_numbers_of_many_seeds_equal_those_of_python():
    for seed in (*range(2000), -1, 2**32 - 1, 2**63 - 1, -(2**63)):
        text = f"octet {seed} {seed % 7}"

        assert drawn(text, 3) == drawn_by_python(text, 3), text


def test_numbers_of_a_text_of_any_length_equal_those_of_python():
    for length in range(101):
        text = "".join(chr(33 + (7 * i) % 90) for i in range(length))

        assert drawn(text, 3) == drawn_by_python(text, 3), text


@pytest.mark.parametrize("text", ["octet 1 1", "octet 7 3 starts", ""])
def test_long_sequence_equals_that_of_python(text):
    assert drawn(text, 10_000) == drawn_by_python(text, 10_000)


@pytest.mark.parametrize("name", DIGESTS)
def test_layouts_of_a_world_equal_the_golden_ones(name):
    assert digest(numbers(world(name).generate(*which)) for which in WANTED) == DIGESTS[name]


SEEDS = range(15)


@pytest.mark.parametrize("name", WORLD_NAMES)
def test_environments_of_all_worlds_are_fair(name):
    world = world_of(name)

    assert all(is_fair(world.generate(seed, 1), world.params) for seed in SEEDS)


@pytest.mark.parametrize("name", WORLD_NAMES)
def test_seed_and_number_determine_the_environment(name):
    world = world_of(name)

    assert world.generate(3, 2) == world.generate(3, 2)
    assert len({world.generate(seed, number) for seed in (1, 2) for number in (1, 2)}) == 4


@pytest.mark.parametrize("name", WORLD_NAMES)
def test_worlds_have_room_for_several_robots(name):
    assert len(world_of(name).generate(5, 1, robots=3).starts) == 3


def test_random_world_equals_that_of_generate():
    assert world_of("random").generate(7, 2, 3) == generate(7, 2, SimParams(), 3)


def test_all_bars_are_inside_the_arena():
    for name in WORLD_NAMES:
        world = world_of(name)
        for x, y in (end for seed in SEEDS for bar in world.generate(seed, 1).bars for end in bar):
            assert 0 <= x <= world.params.width_mm
            assert 0 <= y <= world.params.height_mm


@pytest.mark.parametrize(
    ("text", "meant"),
    [("corridor", "did you mean corridors?"), ("moon", "choose from random, corridors"), ("", "choose from")],
)
def test_unknown_world_is_refused_with_a_suggestion(text, meant):
    with pytest.raises(UsageError, match=meant.replace("?", r"\?")):
        world_of(text)


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


def test_world_file_sets_size_bars_food_and_start(tmp_path):
    world = read(tmp_path, FULL)

    layout = world.generate(1, 1)
    assert (world.name, world.params.width_mm, world.params.height_mm) == ("my.toml", 3000.0, 2000.0)
    assert layout.bars == (Bar((1000.0, 0.0), (1000.0, 1400.0)), Bar((2000.0, 600.0), (2000.0, 2000.0)))
    assert layout.food == ((2700.0, 300.0), (1500.0, 1000.0))
    assert layout.start == pytest.approx(Pose(300.0, 300.0, 1.5707963))


def test_environments_of_a_world_file_have_the_same_layout(tmp_path):
    world = read(tmp_path, FULL)

    assert world.generate(1, 1) == world.generate(2, 7)


def test_missing_start_is_drawn_for_each_environment_and_fair(tmp_path):
    world = read(tmp_path, re.sub("start.*", "", FULL))

    layouts = [world.generate(1, number) for number in range(1, 30)]
    assert len({layout.start for layout in layouts}) == len(layouts)
    assert all(is_fair(layout, world.params) for layout in layouts)


def test_world_file_content_can_be_written_and_read_back(tmp_path):
    world = read(tmp_path, FULL)
    assert isinstance(world.draw, WrittenLayout)

    assert world_from(content_of(world.draw, world.params), "my.toml") == world


def test_example_in_the_documentation_equals_its_file():
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
def test_mistake_in_a_world_file_is_reported_with_its_line_and_reason(tmp_path, text, line, meant):
    with pytest.raises(UsageError) as raised:
        read(tmp_path, text)

    assert str(raised.value).startswith(f"{tmp_path}/my.toml:{line}: {meant}")


@pytest.mark.parametrize("content", [b"\xff\xfe", b"x = " + b"[" * 100_000, b"\0"])
def test_world_file_that_cannot_be_parsed_is_refused(tmp_path, content):
    (tmp_path / "my.toml").write_bytes(content)

    with pytest.raises(UsageError, match=r"my\.toml"):
        world_of(str(tmp_path / "my.toml"))


def test_missing_world_file_is_reported():
    with pytest.raises(UsageError, match=r"there is no file nowhere\.toml"):
        world_of("nowhere.toml")
