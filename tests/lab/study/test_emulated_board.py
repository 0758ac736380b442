"""A study's rows are the same for the flash image on the emulated board."""

from dataclasses import replace

from host_sim.lab.study.sample import samples_of
from host_sim.lab.study.tables import tables_of
from host_sim.lab.study.trial import Trial, run_trial


def test_the_flash_image_learns_by_the_very_curve_of_the_host():
    here = Trial("article", 3, 1, limit_s=14.0)
    there = replace(here, robot="emulated")

    ours, theirs = (run_trial(trial) for trial in (here, there))

    assert theirs.rows == ours.rows
    (curve,) = (sample.blocked_at[0] for sample in samples_of(tables_of([ours])))
    assert curve[1] > 0, "it was blocked more than once"
