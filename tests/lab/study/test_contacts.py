"""Contacts, as counted tick by tick."""

import numpy as np

from host_sim.lab.study.contacts import ContactWatch, _contacts
from host_sim.lab.study.trial import run_trial
from host_sim.protocol.generated import Reason
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from tests.lab.study.support import NOTHING, SOUND, SWAPPED, trial

FRONT_RIGHT = 0b00010
LEARNED = (0, 1, 0, 0, 0, 0, 0, 0)


def test_a_contact_is_from_the_first_turn_to_the_clear_way():
    ticks = [
        (0, Reason.WANDER, 1),
        *[(FRONT_RIGHT, Reason.TRIAL, 2)] * 3,
        *[(FRONT_RIGHT, Reason.REMEMBERED, 3)] * 2,
        (FRONT_RIGHT, Reason.REMEMBERED, 4),
        (0, Reason.WANDER, 5),
        (FRONT_RIGHT, Reason.BOREDOM, 6),
    ]

    first, second = _contacts(np.array(ticks, np.int16), [(0, NOTHING), (5, LEARNED)], [(0, SOUND), (8, SWAPPED)])

    assert (first.tick, first.pattern, first.blocked_ticks, first.cleared) == (1, 1, 6, True)
    assert (first.trials, first.remembered, first.boredoms, first.turns) == (1, 2, 0, 3)
    assert first.sides == LEARNED
    assert (first.body, second.body) == (SOUND, SWAPPED)
    assert (second.tick, second.blocked_ticks, second.boredoms, second.cleared) == (8, 1, 1, False)


def test_the_loop_in_c_and_the_readable_one_give_the_same_contacts():
    def contacts(native: bool):
        watch = ContactWatch(0)
        with make(RunConfig(seed=4, environments=1, limit_s=40.0)) as simulation:
            simulation.native, simulation.watch = native, watch
            list(simulation.run())
        return [(it.tick, it.pattern, it.blocked_ticks, it.turns, it.cleared) for it in watch.contacts()]

    native = contacts(native=True)

    assert native == contacts(native=False)
    assert native


def test_the_turns_of_the_contacts_are_those_that_the_robot_began():
    run = run_trial(trial("article", 2))
    with make(RunConfig(seed=2, environments=1)) as simulation:
        (episode,) = simulation.run()

    contacts = run.rows[0].contacts[0]
    assert sum(it.trials for it in contacts) == episode.begun(Reason.TRIAL)
    assert sum(it.remembered for it in contacts) == episode.begun(Reason.REMEMBERED)
