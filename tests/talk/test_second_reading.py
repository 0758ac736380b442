"""The engine answers as a second reading of the language does, which shares no code with it."""

import random

import pytest

from host_sim.talk import eliza
from tests.talk.random_talk import NASTY, differences, own, random_script


@pytest.mark.parametrize("script", [own("eliza"), own("robot"), NASTY], ids=["eliza", "robot", "all features"])
def test_random_sentences_are_answered_alike(script):
    assert differences(script, 700, seed=1) == []


def test_random_scripts_are_followed_alike():
    draw = random.Random(1)

    assert [it for seed in range(30) for it in differences(random_script(draw), 30, seed)] == []


def test_an_engine_that_is_wrong_is_found(monkeypatch):
    monkeypatch.setattr(eliza, "_DELIMITERS", frozenset({",", "."}))

    assert differences(NASTY, 700, seed=1) != []
