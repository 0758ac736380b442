"""What a robot does about what it touches, and where it is blind, is what the oracle says, over random ticks."""

import random

import pytest

from host_sim.protocol.generated import PROFILES
from tests.firmware.octet_c import load
from tests.firmware.oracles.caution import Action, Caution

FFI, C = load()
TICKS = 4000


@pytest.mark.parametrize("profile", ["article", "searcher"])
def test_random_ticks_are_those_of_the_oracle(profile):
    dice, oracle, seen = random.Random(1), Caution(), set()
    caution, brain, twin = FFI.new("struct caution *"), FFI.new("struct brain *"), FFI.new("struct brain *")
    config, senses = FFI.new("struct config *"), FFI.new("struct senses *")
    C.config_reset(config)
    for one in (brain, twin):
        C.brain_start(one, PROFILES[profile], 1)
    action = Action()

    def ask(feel: int) -> Action:
        senses.feel = feel
        chosen = C.brain_next(twin, config, senses)
        return Action(chosen.forward_mm, chosen.turn_deg)

    blind = False
    for _ in range(TICKS):
        feel, bump = dice.choice([0, 0, 0, 0, 0, 2, 8, 10]), dice.random() < 0.2
        blind = blind ^ (dice.random() < 0.01)
        senses.feel, senses.bump = feel, bump
        forward = action.forward_mm > 0
        stops = oracle.stops(bump, forward)
        assert C.caution_stops(caution, senses, forward) == stops
        if not stops and dice.random() < 0.5:
            continue
        C.caution_see(caution, feel, blind)
        told = C.caution_next(caution, brain, config, senses)
        felt = senses.feel
        assert (felt, Action(told.forward_mm, told.turn_deg)) == oracle.next(feel, bump, blind, ask)
        action = Action(told.forward_mm, told.turn_deg)
        seen.add(action if told.reason == C.REASON_AVOID else told.reason)
    assert seen >= {Action(-20, 0), Action(0, -24), Action(0, 24), C.REASON_TRIAL, C.REASON_REMEMBERED}
