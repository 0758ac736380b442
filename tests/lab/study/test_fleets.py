"""A study's conditions as fleets: the same figures as from runs of their own."""

from dataclasses import fields

import numpy as np
import pytest

from host_sim.base.errors import UsageError
from host_sim.lab.study.fleets import samples_of_fleets
from host_sim.lab.study.plan import Plan
from host_sim.lab.study.sample import TRAPPED_S, samples_of
from host_sim.lab.study.tables import tables_of
from host_sim.lab.study.trial import Trial, run_trial
from host_sim.sim.native_fleet import loaded
from host_sim.sim.run_config import RunConfig
from host_sim.world.params import SimParams

LOGGED = {"known_s", "blocked_at", "wrong_at", "recovery", "settled"}
"""What only logs tell."""


@pytest.mark.parametrize("body", ["ideal", "kit"])
def test_a_fleet_has_the_figures_of_runs_of_their_own(body):
    plan = Plan("", [Trial(RunConfig(environments=2, limit_s=40.0, profile="never", body=body))], 3, 3)

    (one,), (other,) = samples_of_fleets(plan), samples_of(tables_of(map(run_trial, plan.trials())))

    for name in {it.name for it in fields(one)} - LOGGED - {"name", "robots"}:
        assert np.allclose(getattr(one, name), getattr(other, name)), name
    assert one.contacts.sum() > 0


def test_a_contact_counts_as_far_as_in_a_study():
    assert loaded()[1].FLEET_TRAPPED_TICKS * SimParams().tick_s == TRAPPED_S


def test_what_a_fleet_cannot_do_is_refused():
    plan = Plan("", [Trial(RunConfig(changes=("mirror@1s",)))])

    with pytest.raises(UsageError, match="tools/octet study"):
        samples_of_fleets(plan)
