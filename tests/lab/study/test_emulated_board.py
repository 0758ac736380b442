"""A study's rows are the same for the flash image on the emulated board."""

from host_sim.lab.study.sample import samples_of
from host_sim.lab.study.tables import tables_of
from host_sim.lab.study.trial import run_trial
from tests.lab.study.support import trial


def test_flash_image_has_the_learning_curve_of_the_host():
    here, there = (trial("article", 3, limit_s=14.0, robot=robot) for robot in ("spawn", "emulated"))

    ours, theirs = (run_trial(each) for each in (here, there))

    assert theirs["contacts"] == ours["contacts"] != []
    assert theirs["environments"] == ours["environments"]
    (curve,) = (sample.blocked_at[0] for sample in samples_of(tables_of([ours])))
    assert curve[1] > 0, "it was blocked more than once"
