"""The picture of a fleet: every robot has its square, or its place in the common world."""

from dataclasses import replace

import pytest
from PIL import Image

from host_sim.report.fleet_picture import write_fleet_picture
from host_sim.sim.fleet import FleetResult
from host_sim.sim.native_fleet import Contacts
from host_sim.world.geometry import Pose
from host_sim.world.layouts import generate
from host_sim.world.params import SimParams

PARAMS = SimParams()
ORANGE = (213, 94, 0)


def result(robot: int, finished: bool = True, environment: int = 1, sides: tuple[int, ...] = (0,) * 8) -> FleetResult:
    pose = Pose(100.0 + 35.0 * (robot % 100), 200.0 + 300.0 * (robot // 100), 0.0)
    none = Contacts(0, 0, 0, False)
    return FleetResult(robot, robot, environment, (finished,), 1, 3000 + robot, {}, 0, 0, none, sides, pose)


def drawn(folder, results, world=None) -> Image.Image:
    write_fleet_picture(folder / "fleet.png", results, PARAMS, world)
    with Image.open(folder / "fleet.png") as picture:
        return picture.convert("RGB")


def pixels(picture: Image.Image, colour: tuple[int, int, int]) -> int:
    return sum(count for count, found in picture.getcolors(1 << 24) if found == colour)


def test_a_short_run_has_seconds_on_its_axis(tmp_path, monkeypatch):
    said = []
    monkeypatch.setattr("host_sim.report.fleet_picture.write", lambda *given: said.append(given[2]))

    drawn(tmp_path, [replace(result(1), ticks=100)])

    assert [text for text in said if text.endswith(" s")] == ["0 s", "1 s", "2 s"]


def test_each_robot_that_did_not_finish_is_an_orange_square(tmp_path):
    counts = [
        pixels(drawn(tmp_path, [result(robot, finished=robot > few) for robot in range(1, 1001)]), ORANGE)
        for few in (1, 2, 12)
    ]

    square = counts[1] - counts[0]
    assert square > 400
    assert counts[2] - counts[1] == pytest.approx(10 * square, rel=0.02)


def test_ten_thousand_robots_fit_into_a_picture_of_moderate_size(tmp_path):
    picture = drawn(tmp_path, [result(robot, environment=n) for robot in range(1, 10_001) for n in range(1, 8)])

    assert picture.size[1] < 2000
    assert (tmp_path / "fleet.png").stat().st_size < 400_000


def test_nobody_having_finished_is_a_picture_too(tmp_path):
    assert pixels(drawn(tmp_path, [result(1, finished=False)]), ORANGE) > 1000


def test_equal_runs_give_equal_bytes(tmp_path):
    results = [result(robot) for robot in range(1, 50)]

    assert drawn(tmp_path, results).tobytes() == drawn(tmp_path, results[::-1]).tobytes()


def test_a_common_world_is_shown_with_all_its_robots(tmp_path):
    world = generate(1, 1, PARAMS), (True, True, False)
    few, many = [result(1)], [result(robot) for robot in range(1, 700, 7)]

    dark = (32, 38, 46)
    assert pixels(drawn(tmp_path, many, world), dark) > 2 * pixels(drawn(tmp_path, few, world), dark)
