"""All that samples are taken of in test_second_reading.py and test_robot.py."""

import random

import pytest

from host_sim.api import RunConfig, run
from tests.talk.frames import Frames
from tests.talk.frames import differences as differences_from_frames
from tests.talk.random_talk import NASTY, differences, own, random_script

SENTENCES = 40_000


@pytest.mark.parametrize("script", [own("eliza"), own("robot"), NASTY], ids=["eliza", "robot", "all features"])
def test_engine_answers_40000_sentences_as_the_second_reading(script):
    assert differences(script, SENTENCES, seed=2) == []


def test_engine_follows_1000_random_scripts_as_the_second_reading():
    draw = random.Random(2)

    assert [it for seed in range(1000) for it in differences(random_script(draw), 40, seed)] == []


def test_ten_thousand_answers_about_twenty_runs_match_the_frames(tmp_path):
    count, found = 0, []
    draw = random.Random(3)
    for seed in range(20):
        profile = ("article", "rearmed", "forgetful", "adaptive", "searcher")[seed % 5]
        world = ("random", "crowded", "corridors")[seed % 3]
        log = tmp_path / f"{seed}.log"
        run(RunConfig(seed=seed, environments=1, limit_s=90, bus="none", profile=profile, world=world), log)
        last = len(Frames(log).ticks) - 1
        ticks = sorted(draw.randrange(last + 1) for _ in range(20))
        asked, wrong = differences_from_frames(log, ticks, [draw.randrange(last + 1) for _ in range(3)])
        count, found = count + asked, found + wrong
    assert count >= 10_000
    assert found == []
