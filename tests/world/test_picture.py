"""The picture of a run: a small PNG that shows every environment, the path in its colours, and the memory."""

import random
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from host_sim.report.picture import draw_run
from host_sim.world.geometry import Pose
from host_sim.world.layouts import Layout, generate
from host_sim.world.params import SimParams

PARAMS = SimParams()
EMPTY_MEMORY = [0] * 8
LEARNED_MEMORY = [0, 1, 2, 1, 2, 1, 2, 0]
FOOD_GREEN, TRIAL_ORANGE, BORED_PINK = (0, 158, 115), (213, 94, 0), (204, 121, 167)


class EpisodeResult(NamedTuple):
    layout: Layout = Layout((), ((1000.0, 2000.0),), Pose(2000.0, 1500.0, 0.0))
    trail: tuple[tuple[float, float, int], ...] = ()
    eaten: tuple[bool, ...] = (False,)
    robot_s: float = 145.0
    finished: bool = False


def busy_chapter(seed: int) -> EpisodeResult:
    """Ten robot minutes of ways and turns all over the arena."""
    draws, trail = random.Random(seed), []
    x, y = 2000.0, 1500.0
    for _ in range(30_000):
        x = min(3900.0, max(100.0, x + draws.uniform(-20, 20)))
        y = min(2900.0, max(100.0, y + draws.uniform(-20, 20)))
        trail.append((x, y, draws.choice((1, 1, 1, 3, 3, 2, 4, 5, 6))))
    return EpisodeResult(generate(seed, 1, PARAMS), tuple(trail), (True, False, True), 600.0)


def picture(path: Path, *episodes: EpisodeResult, memory: list[int] = EMPTY_MEMORY) -> NDArray[np.uint8]:
    """Draws, and reads back as pixels: shape (height, width, 3)."""
    draw_run(path / "arena.png", PARAMS, episodes, memory)
    with Image.open(path / "arena.png") as image:
        return np.asarray(image.convert("RGB"))


def count(pixels: NDArray[np.uint8], colour: tuple[int, int, int]) -> int:
    return int((abs(pixels.astype(int) - colour).max(axis=2) <= 3).sum())


def test_the_same_run_gives_the_same_bytes(tmp_path: Path) -> None:
    draw_run(tmp_path / "one.png", PARAMS, [busy_chapter(1)], LEARNED_MEMORY)
    draw_run(tmp_path / "two.png", PARAMS, [busy_chapter(1)], LEARNED_MEMORY)

    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "two.png").read_bytes()


@pytest.mark.parametrize("environments", [1, 9, 10])
def test_the_busiest_picture_stays_below_400_kb(tmp_path: Path, environments: int) -> None:
    draw_run(tmp_path / "arena.png", PARAMS, [busy_chapter(1)] * environments, LEARNED_MEMORY)

    assert (tmp_path / "arena.png").stat().st_size < 400_000


def test_all_pictures_are_equally_wide_and_grow_by_the_row(tmp_path: Path) -> None:
    shapes = {n: picture(tmp_path, *[EpisodeResult()] * n).shape for n in (3, 4, 6, 7, 9, 10)}

    assert {width for _, width, _ in shapes.values()} == {1680}
    assert shapes[3] < shapes[4] == shapes[6] < shapes[7] == shapes[9] == shapes[10]


def test_longer_runs_show_their_last_nine_environments(tmp_path: Path) -> None:
    orange = EpisodeResult(trail=((1000.0, 1000.0, 1), (1000.0, 1000.0, 5), (1000.0, 1500.0, 1)))

    without = count(picture(tmp_path, orange, *[EpisodeResult()] * 9), TRIAL_ORANGE)
    with_it = count(picture(tmp_path, *[EpisodeResult()] * 9, orange), TRIAL_ORANGE)

    assert with_it > without


@pytest.mark.parametrize(("reason", "colour"), [(2, FOOD_GREEN), (5, TRIAL_ORANGE), (6, BORED_PINK)])
def test_the_path_has_the_colour_of_its_reason(tmp_path: Path, reason: int, colour: tuple[int, int, int]) -> None:
    still = picture(tmp_path, EpisodeResult())
    acted = picture(
        tmp_path, EpisodeResult(trail=((2600.0, 1500.0, 1), (2900.0, 1500.0, reason), (2900.0, 900.0, 1)))
    )

    assert count(acted, colour) > count(still, colour) + 20


def test_food_is_a_full_disc_until_it_is_eaten(tmp_path: Path) -> None:
    left = picture(tmp_path, EpisodeResult(eaten=(False,)))
    eaten = picture(tmp_path, EpisodeResult(eaten=(True,)))

    assert count(left, FOOD_GREEN) > count(eaten, FOOD_GREEN) + 100


def test_a_learned_memory_shows_arrows(tmp_path: Path) -> None:
    empty = picture(tmp_path, EpisodeResult())
    learned = picture(tmp_path, EpisodeResult(), memory=LEARNED_MEMORY)

    changed = np.argwhere((abs(empty.astype(int) - learned) > 60).any(axis=2))
    assert len(changed) > 1000
    assert changed[:, 0].min() > empty.shape[0] - 250


def test_left_and_right_arrows_mirror_each_other(tmp_path: Path) -> None:
    cell_px = 1608 // 8
    sides = []
    for action in (1, 2):
        pixels = picture(tmp_path, EpisodeResult(), memory=[0, 0, action, 0, 0, 0, 0, 0])
        cell = pixels[-200:-100, 36 + 2 * cell_px : 36 + 3 * cell_px]
        dark = cell.sum(axis=2) < 300
        sides.append(int(dark[:, :100].sum() - dark[:, -100:].sum()))

    assert sides[0] > 100
    assert sides[0] == pytest.approx(-sides[1], rel=0.15)


@pytest.mark.parametrize(("episodes", "cells"), [(0, 8), (1, 7)])
def test_a_run_without_environments_or_with_too_few_cells_is_refused(
    tmp_path: Path, episodes: int, cells: int
) -> None:
    with pytest.raises(ValueError, match=f"{episodes} environments and {cells} cells"):
        draw_run(tmp_path / "arena.png", PARAMS, [EpisodeResult()] * episodes, [0] * cells)

    assert not (tmp_path / "arena.png").exists()
