"""Every profile runs, and a memory that one has written is understood by each other."""

import itertools

import pytest

from host_sim.client.frame_log import FrameLog
from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import MEMORY_KINDS, PROFILES, MemoryKind
from host_sim.protocol.memory_kinds import kinds_of, sides_of
from host_sim.recording.log_reader import read_log
from host_sim.recording.replay import replay
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig

SIDES = (0, 1, 2, 1, 2, 0, 2, 1)
WRITTEN = {
    MemoryKind.SIDES: SIDES,
    MemoryKind.CONFIDENCE: (0, 5, 10, 13, 6, 0, 14, 5),
    MemoryKind.ALL_SENSORS: (0x5F, 0xAA, 0x80, 0x00, 0x50, 0xAA, 0x00, 0x40),
}


@pytest.mark.parametrize("profile", PROFILES)
def test_a_run_of_each_profile_is_replayed_without_a_difference(profile, tmp_path):
    path = tmp_path / "run.log"
    log = FrameLog(path)
    with make(RunConfig(seed=3, environments=1, limit_s=20, profile=profile), log) as simulation:
        (episode,) = simulation.run()
    log.close()

    outcome = replay(read_log(path), Protocol())

    assert outcome.difference is None
    assert outcome.drives >= episode.ticks
    assert MEMORY_KINDS[profile] in kinds_of(episode.robots[0].memory)


@pytest.mark.parametrize(("kind", "profile"), list(itertools.product(MemoryKind, PROFILES)))
def test_a_memory_of_each_kind_is_understood_by_each_profile(kind, profile):
    config = RunConfig(environments=1, limit_s=0.1, profile=profile, settings={"speed_mm_s": 20})
    with make(config, memories=[WRITTEN[kind]]) as simulation:
        memory = simulation.clients[0].memory

    assert MEMORY_KINDS[profile] in kinds_of(memory)
    assert sides_of(memory) == sides_of(WRITTEN[kind])


def test_a_start_with_another_profile_translates_what_was_learned():
    with make(RunConfig(profile="adaptive"), memories=[SIDES]) as simulation:
        (client,) = simulation.clients
        learned = client.memory
        client.dialogue.command("start", profile=PROFILES["article"], seed=1, lockstep=1)
        client.dialogue.await_memory()

    assert (kinds_of(learned), client.memory) == ([MemoryKind.CONFIDENCE], SIDES)
