"""Plots of a study, and Heiserman's creatures in them."""

import numpy as np
import pytest
from PIL import Image

from host_sim.lab.study.heiserman import CLASSES, scores
from host_sim.lab.study.plots import draw_plots
from tests.lab.study.support import SWAPPED, contact, row, run, samples


def test_each_plot_is_a_picture(tmp_path):
    changed = row(number=2, contacts=[contact(body=SWAPPED)], bodies=[SWAPPED])
    few = samples(*(run(name, seed, row(10.0 * seed), changed) for name in "ab" for seed in (1, 2)))

    paths = draw_plots(few, tmp_path / "new/plots")

    assert [path.stem for path in paths] == ["learning", "survival", "score", "recovery"]
    for path in paths:
        with Image.open(path) as picture:
            assert picture.size == (770, 462)


def test_without_a_change_there_is_no_recovery_to_draw(tmp_path):
    assert "recovery" not in [path.stem for path in draw_plots(samples(run("a", 1, row())), tmp_path)]


@pytest.mark.parametrize("kind", CLASSES)
def test_a_creature_is_the_same_for_the_same_seed_and_scores_what_it_did(kind):
    curve = list(scores(kind, 7, 50))

    assert curve == list(scores(kind, 7, 50))
    assert len(curve) == 50
    good = np.array(curve) * np.arange(1, 51)
    assert np.allclose(np.diff(good, prepend=0), np.round(np.diff(good, prepend=0)))


def test_who_remembers_scores_more_and_who_does_not_never_learns():
    early, late = (
        {kind: np.mean([list(scores(kind, seed, count))[-1] for seed in range(60)]) for kind in CLASSES}
        for count in (10, 100)
    )

    assert early["Alpha"] == pytest.approx(late["Alpha"], abs=0.06)
    assert late["Beta"] > late["Alpha"] + 0.25
    assert late["Gamma"] > late["Alpha"] + 0.25
