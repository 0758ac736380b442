"""A run drawn in plain characters of any size."""

import re
from dataclasses import replace

import pytest

from host_sim.live import terminal_view
from host_sim.live.text_picture import draw_text
from host_sim.recording.phrases import sentence
from host_sim.recording.state_types import EnvironmentScene, Trial


@pytest.mark.parametrize(("columns", "rows"), [(60, 20), (80, 24), (100, 20), (60, 50), (250, 80)])
def test_the_picture_fits_any_screen(view, columns, rows):
    lines = draw_text(view, columns, rows)

    assert len(lines) <= rows
    assert max(map(len, lines)) <= columns
    assert all(line.isascii() for line in lines)


@pytest.mark.parametrize(("columns", "rows"), [(60, 20), (80, 24), (250, 80)])
def test_the_picture_tells_all_there_is_to_know(view, columns, rows):
    lines = draw_text(view, columns, rows)
    text, arena = "\n".join(lines), "".join(line for line in lines if line.startswith("|"))

    assert "environment 1 of 1   eaten 0 of 3   0:03.4   1 x real time" in text
    assert sentence(view.state) in " ".join(text.split())
    assert "> .|/  -" in text
    assert (arena.count("@"), arena.count("O"), "#" in arena) == (1, 3, True)
    assert "@ robot   O food   x eaten   # obstacle" in text
    assert "q quits" in text


@pytest.mark.parametrize(("columns", "rows"), [(59, 24), (80, 19), (1, 1), (7, 3)])
def test_on_a_screen_too_small_it_says_how_large(view, columns, rows):
    lines = draw_text(view, columns, rows)

    assert len(lines) <= rows
    assert max(map(len, lines)) <= columns
    assert re.match(r"\d", lines[0])


@pytest.mark.parametrize("columns", [60, 80])
def test_all_keys_are_named_on_the_smallest_screen(view, columns):
    lines = draw_text(replace(view, keys=terminal_view._KEYS), columns, 20)

    assert lines[-2:] == terminal_view._KEYS.splitlines()


@pytest.mark.parametrize(("helped", "said"), [(0, "It did not help, so I forgot it."), (1, "so I remembered it!")])
def test_it_says_whether_a_try_helped(view, helped, said):
    trial = Trial(tick=160, cell=7, side=1, helped=helped, frozen=0)
    lines = draw_text(replace(view, states=[{**view.state, "trial": trial}]), 60, 20)

    assert said in " ".join(" ".join(lines).split())
    assert len(lines) <= 20


@pytest.mark.parametrize(
    ("heading", "row", "column", "nose"),
    [
        (0, 0, 1, "-"),
        (785, 1, 1, "\\"),
        (1571, 1, 0, "|"),
        (2356, 1, -1, "/"),
        (-1571, -1, 0, "|"),
        (3141, 0, -1, "-"),
    ],
)
def test_the_nose_is_where_the_robot_looks(view, heading, row, column, nose):
    state = {**view.state, "x": 2000.0, "y": 1500.0, "heading": heading, "eaten": []}
    lines = draw_text(replace(view, states=[state], scene={**view.scene, "bars": [], "food": []}, trails=[]), 80, 24)

    at_row = next(i for i, line in enumerate(lines) if "@" in line)
    assert lines[at_row + row][lines[at_row].index("@") + column] == nose


def test_the_arena_is_as_wide_as_it_is_in_the_world(view):
    lines = draw_text(view, 200, 60)

    width, height = lines[1].count("-"), sum(line.startswith("|") for line in lines)
    assert width / (2 * height) == pytest.approx(4 / 3, rel=0.05)


def test_it_shows_plants_and_says_what_happened(view):
    scene = EnvironmentScene(**view.scene, plants=[[0, 2000.0, 1500.0, 200.0]])

    lines = draw_text(replace(view, scene=scene, news="A plant was put down."), 100, 30)

    assert any("*" in line for line in lines)
    assert "A plant was put down." in lines
