"""The picture of a run, of a fleet and of a world: small PNGs."""

import random
from collections.abc import Sequence
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageChops

from host_sim.cli.main import main
from host_sim.protocol.generated import ROW
from host_sim.recording.state import environment_scene
from host_sim.recording.state_types import EnvironmentScene
from host_sim.recording.trajectory import RobotTrack, Trajectory
from host_sim.report.fleet_picture import write_fleet_picture
from host_sim.report.picture import draw_run, omissions
from host_sim.sim.fleet import FleetResult
from host_sim.sim.native_fleet import Contacts
from host_sim.sim.world_record import Begun
from host_sim.world.arena import Arena
from host_sim.world.geometry import Pose, SimParams
from host_sim.world.layouts import generate
from host_sim.world.names import WORLD_NAMES

PARAMS = SimParams()
EMPTY_MEMORY = [0] * 8
LEARNED_MEMORY = [0, 1, 2, 1, 2, 1, 2, 0]
FOOD_GREEN, TRIAL_ORANGE, BORED_PINK = (0, 158, 115), (213, 94, 0), (204, 121, 167)


SCENE = EnvironmentScene(number=1, of=1, seed=1, first_tick=0, start_tick=0, bars=[], food=[[1000.0, 2000.0]])
Trail = Sequence[tuple[float, float, int]]
STAY: Trail = ((2000.0, 1500.0, 1),)


class Panel(NamedTuple):
    """An environment: what each robot does in each of its ticks, and how it ends."""

    trails: Sequence[Trail]
    eaten: Sequence[int] = (0,)
    scene: EnvironmentScene = SCENE


def panel(trail: Trail = (), eaten: Sequence[int] = (0,), scene: EnvironmentScene = SCENE) -> Panel:
    return Panel([(*STAY, *trail)], eaten, scene)


def run(*panels: Panel, memories: Sequence[Sequence[int]] = (EMPTY_MEMORY,)) -> Trajectory:
    """A run of some environments; each robot's memory is as at its end."""
    tracks = [RobotTrack(node, memories=[(0, list(memory))]) for node, memory in enumerate(memories, 1)]
    trajectory = Trajectory(PARAMS, 6, tracks, environments=len(panels))
    for number, (trails, eaten, scene) in enumerate(panels, 1):
        new = {"number": number, "first_tick": trajectory.ticks}
        trajectory.scenes.append((trajectory.ticks, EnvironmentScene(**{**scene, **new})))
        trajectory.meals.append((trajectory.ticks, list(eaten)))
        for track, trail in zip(tracks, trails, strict=True):
            for x, y, reason in trail:
                track.poses_flat.extend((x, y, 0.0))
                track.rows_flat.extend(reason if name == "reason" else 0 for name in ROW)
    return trajectory


def busy_panel(seed: int) -> Panel:
    """Ten robot minutes of ways and turns all over the arena."""
    draws, trail = random.Random(seed), []
    x, y = 2000.0, 1500.0
    for _ in range(30_000):
        x = min(3900.0, max(100.0, x + draws.uniform(-20, 20)))
        y = min(2900.0, max(100.0, y + draws.uniform(-20, 20)))
        trail.append((x, y, draws.choice((1, 1, 1, 3, 3, 2, 4, 5, 6))))
    arena = Arena(generate(seed, 1, PARAMS), PARAMS)
    return panel(trail, (1, 0, 1), environment_scene([Begun(seed, 1, 0)], 1, arena))


def png(*panels: Panel, memory: Sequence[int] = EMPTY_MEMORY) -> bytes:
    content = BytesIO()
    draw_run(run(*panels, memories=[memory])).save(content, "PNG")
    return content.getvalue()


def picture(*panels: Panel, memory: Sequence[int] = EMPTY_MEMORY) -> NDArray[np.uint8]:
    """Draws, and gives the pixels: shape (height, width, 3)."""
    return np.asarray(draw_run(run(*panels, memories=[memory])).convert("RGB"))


def count(pixels: NDArray[np.uint8], colour: tuple[int, int, int]) -> int:
    return int((abs(pixels.astype(int) - colour).max(axis=2) <= 3).sum())


def test_run_picture_has_the_same_bytes_for_the_same_run() -> None:
    assert png(busy_panel(1), memory=LEARNED_MEMORY) == png(busy_panel(1), memory=LEARNED_MEMORY)


@pytest.mark.parametrize("environments", [1, 10])
def test_busiest_picture_stays_below_400_kb(environments: int) -> None:
    assert len(png(*[busy_panel(1)] * environments, memory=LEARNED_MEMORY)) < 400_000


def test_pictures_have_one_width_and_grow_by_the_row() -> None:
    shapes = {n: picture(*[panel()] * n).shape for n in (3, 4, 6, 7, 9, 10)}

    assert {width for _, width, _ in shapes.values()} == {1680}
    assert shapes[3] < shapes[4] == shapes[6] < shapes[7] == shapes[9] < shapes[10]


def test_picture_names_what_it_leaves_out() -> None:
    assert omissions(9, 8) == []
    assert omissions(20, 9) == ["the last 9 of 20 environments", "the memories of the first 8 of 9 robots"]


def test_longer_runs_show_their_last_nine_environments() -> None:
    orange = panel(trail=((1000.0, 1000.0, 1), (1000.0, 1000.0, 5), (1000.0, 1500.0, 1)))

    without = count(picture(orange, *[panel()] * 9), TRIAL_ORANGE)
    with_it = count(picture(*[panel()] * 9, orange), TRIAL_ORANGE)

    assert with_it > without


@pytest.mark.parametrize(("reason", "colour"), [(2, FOOD_GREEN), (5, TRIAL_ORANGE), (6, BORED_PINK)])
def test_path_has_the_colour_of_its_reason(reason: int, colour: tuple[int, int, int]) -> None:
    still = picture(panel())
    acted = picture(panel(trail=((2600.0, 1500.0, 1), (2900.0, 1500.0, reason), (2900.0, 900.0, 1))))

    assert count(acted, colour) > count(still, colour) + 20


def test_food_is_a_full_disc_until_it_is_eaten() -> None:
    left = picture(panel(eaten=(False,)))
    eaten = picture(panel(eaten=(True,)))

    assert count(left, FOOD_GREEN) > count(eaten, FOOD_GREEN) + 100


def test_learned_memory_shows_arrows() -> None:
    empty = picture(panel())
    learned = picture(panel(), memory=LEARNED_MEMORY)

    changed = np.argwhere((abs(empty.astype(int) - learned) > 60).any(axis=2))
    assert len(changed) > 1000
    assert changed[:, 0].min() > empty.shape[0] - 250


def test_left_and_right_arrows_mirror_each_other() -> None:
    cell_px = 1608 // 8
    sides = []
    for action in (1, 2):
        pixels = picture(panel(), memory=[0, 0, action, 0, 0, 0, 0, 0])
        cell = pixels[-200:-100, 36 + 2 * cell_px : 36 + 3 * cell_px]
        dark = cell.sum(axis=2) < 300
        sides.append(int(dark[:, :100].sum() - dark[:, -100:].sum()))

    assert sides[0] > 100
    assert sides[0] == pytest.approx(-sides[1], rel=0.15)


def test_picture_of_several_robots_shows_path_and_memory_of_each() -> None:
    alone = draw_run(run(panel()))
    trail = [(2600.0, 1500.0, 1), (2900.0, 1500.0, 1), (2900.0, 1500.0, 5), (2900.0, 900.0, 1)]
    two = Panel([STAY * len(trail), trail])

    both = draw_run(run(two, memories=[EMPTY_MEMORY, LEARNED_MEMORY]))

    assert both.height > alone.height + 150
    orange = [count(np.asarray(image.convert("RGB")), TRIAL_ORANGE) for image in (alone, both)]
    assert orange[1] > orange[0]


def test_plant_is_drawn_and_news_is_told_below_the_environments():
    scene = EnvironmentScene(**SCENE, plants=[[0, 1000.0, 500.0, 300.0]])
    bare, planted = (draw_run(run(panel(scene=one))) for one in (SCENE, scene))
    changed = run(panel())
    changed.news = [(0, "A plant was put down.")]
    told = draw_run(changed)

    assert np.any(np.asarray(bare.convert("RGB")) != np.asarray(planted.convert("RGB")))
    assert told.height > bare.height


ORANGE = (213, 94, 0)


def result(robot: int, finished: bool = True, environment: int = 1, sides: tuple[int, ...] = (0,) * 8) -> FleetResult:
    pose = Pose(100.0 + 35.0 * (robot % 100), 200.0 + 300.0 * (robot // 100), 0.0)
    none = Contacts(0, 0, 0, False)
    return FleetResult(robot, robot, environment, (finished,), 1, 3000 + robot, {}, 0, 0, None, none, sides, pose)


def drawn(folder, results, world=None) -> Image.Image:
    write_fleet_picture(folder / "fleet.png", results, PARAMS, world)
    with Image.open(folder / "fleet.png") as picture:
        return picture.convert("RGB")


def pixels(picture: Image.Image, colour: tuple[int, int, int]) -> int:
    return sum(count for count, found in picture.getcolors(1 << 24) if found == colour)


def test_fleet_picture_of_a_short_run_has_seconds_on_its_axis(tmp_path, monkeypatch):
    said = []
    monkeypatch.setattr("host_sim.report.fleet_picture.write", lambda *given: said.append(given[2]))

    drawn(tmp_path, [replace(result(1), ticks=100)])

    assert [text for text in said if text.endswith(" s")] == ["0 s", "1 s", "2 s"]


def test_fleet_picture_shows_unfinished_robots_as_orange_squares(tmp_path):
    counts = [
        pixels(drawn(tmp_path, [result(robot, finished=robot > few) for robot in range(1, 1001)]), ORANGE)
        for few in (1, 2, 12)
    ]

    square = counts[1] - counts[0]
    assert square > 400
    assert counts[2] - counts[1] == pytest.approx(10 * square, rel=0.02)


def test_fleet_picture_of_ten_thousand_robots_has_a_moderate_size(tmp_path):
    picture = drawn(tmp_path, [result(robot, environment=n) for robot in range(1, 10_001) for n in range(1, 8)])

    assert picture.size[1] < 2000
    assert (tmp_path / "fleet.png").stat().st_size < 400_000


def test_fleet_picture_is_drawn_if_no_robot_finished(tmp_path):
    assert pixels(drawn(tmp_path, [result(1, finished=False)]), ORANGE) > 1000


def test_fleet_picture_is_the_same_for_results_in_any_order(tmp_path):
    results = [result(robot) for robot in range(1, 50)]

    assert drawn(tmp_path, results).tobytes() == drawn(tmp_path, results[::-1]).tobytes()


def test_common_world_is_drawn_with_all_its_robots(tmp_path):
    world = generate(1, 1, PARAMS), (True, True, False)
    few, many = [result(1)], [result(robot) for robot in range(1, 700, 7)]

    dark = (32, 38, 46)
    assert pixels(drawn(tmp_path, many, world), dark) > 2 * pixels(drawn(tmp_path, few, world), dark)


IMAGES = Path(__file__).resolve().parents[2] / "docs/images"


@pytest.mark.parametrize("name", WORLD_NAMES)
def test_documented_world_pictures_are_those_of_the_command(name, tmp_path):
    drawn = tmp_path / "drawn.png"

    assert main(["world", name, "--width", "320", "--png", str(drawn)]) == 0

    with Image.open(drawn) as new, Image.open(IMAGES / f"world-{name}.png") as old:
        assert ImageChops.difference(new.convert("RGB"), old.convert("RGB")).getbbox() is None


def test_world_command_says_what_an_environment_has(capsys):
    assert main(["world", "small"]) == 0

    said = "small: 2000 x 1500 mm, 2 obstacles, 3 pieces of food, all of which can be reached\n"
    assert capsys.readouterr().out == said


def test_world_command_refuses_an_unknown_world_in_one_line(capsys):
    assert main(["world", "smal"]) == 2

    assert capsys.readouterr().err == "octet: there is no world 'smal': did you mean small?\n"
