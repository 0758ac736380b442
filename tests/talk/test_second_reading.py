"""The engine answers as a second reading of the language does, which shares no code with it."""

import random

import pytest

from host_sim.talk import eliza
from tests.talk.random_talk import NASTY, differences, own, random_script


@pytest.mark.parametrize("script", [own("eliza"), own("robot"), NASTY], ids=["eliza", "robot", "all features"])
def test_engine_answers_random_sentences_as_the_second_reading(script):
    assert differences(script, 700, seed=1) == []


def test_engine_follows_random_scripts_as_the_second_reading():
    draw = random.Random(1)

    assert [it for seed in range(30) for it in differences(random_script(draw), 30, seed)] == []


def test_second_reading_detects_a_wrong_engine(monkeypatch):
    monkeypatch.setattr(eliza, "_DELIMITERS", frozenset({",", "."}))

    assert differences(NASTY, 700, seed=1) != []
