"""The other half of the wire: a body on the pins of a Blue Pill or a Nucleo, and a brain on a Feather."""

from itertools import pairwise

import pytest

from host_sim.api import run
from host_sim.protocol.codec import COUNTERS, Frame, Protocol
from host_sim.protocol.generated import ANSWER_WANTS_RANGES, MESSAGES, PROFILES, TICK_SPAN, Opcode, Reason, Result
from host_sim.recording.log_reader import read_log
from host_sim.sim.run_config import RunConfig
from tests.image.two_boards import TwoBoards, kit_arena

PROTOCOL = Protocol()


@pytest.fixture
def boards():
    return TwoBoards()


def decoded(frames):
    return [it for it in map(PROTOCOL.decode, frames) if it is not None]


def started(boards, presses=1):
    for _ in range(presses):
        boards.press()
    boards.pass_time(1.2)
    return boards


def of_the_boards(profile, tmp_path):  # noqa: ARG001 - the other one writes a log
    boards = started(TwoBoards(), 1 + PROFILES[profile])
    boards.live(kit_arena(), 150)
    return [frame for _, frame in boards.heard]


def of_the_simulator(profile, tmp_path):
    run(RunConfig(seed=2, environments=1, limit_s=3.0, profile=profile), tmp_path / "run.log")
    return [recorded.frame for recorded in read_log(tmp_path / "run.log")]


@pytest.mark.parametrize("profile", ["article", "distance"])
@pytest.mark.parametrize("source", [of_the_boards, of_the_simulator])
def test_bodies_keep_the_contract_of_the_wire(source, profile, tmp_path):
    frames = source(profile, tmp_path)
    said = decoded(frames)
    begun = next(i for i, it in enumerate(said) if it.name == "ANSWER" and it.signals["opcode"] == Opcode.START)
    wants = bool(said[begun].signals["value"] & ANSWER_WANTS_RANGES)
    assert wants == (profile == "distance")
    senses = [it.signals for it in said[begun:] if it.name == "SENSES"]
    assert len(senses) > 100
    for one, next_ in pairwise(senses):
        assert next_["tick"] == (one["tick"] + 1) % TICK_SPAN
        assert next_["counter"] == (one["counter"] + 1) % COUNTERS
    own = [it for it in said[begun + 1 :] if MESSAGES[it.name].sender == "SIM"]  # the robot answers in between
    before = [one for one, next_ in pairwise(own) if next_.name == "SENSES"]
    assert all((it.name == "RANGES") == wants for it in before)
    drives = {(it.signals["tick"], it.signals["counter"]) for it in said[begun:] if it.name == "DRIVE"}
    assert all((it["tick"], it["counter"]) in drives for it in senses[:-1])
    orders = [it.signals for it in said if it.name == "COMMAND"]
    assert len({it["owner"] for it in orders}) == 1
    assert all(it.signals["result"] == Result.DONE for it in said if it.name == "ANSWER")


@pytest.mark.parametrize("body", ["blue_pill", "nucleo_g431rb"])
def test_body_node_drives_without_collisions(body):
    boards, place = TwoBoards(body=body), kit_arena()
    start = place.body.pose
    started(boards).live(place, 300)
    assert abs(place.body.pose.x_mm - start.x_mm) + abs(place.body.pose.y_mm - start.y_mm) > 100
    assert place.body.collisions == 0
    assert boards.body.resets == boards.brain.resets == []
    faults = [it for it in decoded(frame for _, frame in boards.heard) if it.name == "FAULTS"]
    assert not any(faults[-1].signals.get(name) for name in ("missed", "stale", "damaged", "contradictions"))


def rolls(boards):
    """Whether a wheel turns within 20 ms, by more than the count by which it may hunt at rest."""
    before = [boards.robot.timers[name].registers[0x24].value for name in ("TIM3", "TIM4")]
    boards.pass_time(0.02)
    now = [boards.robot.timers[name].registers[0x24].value for name in ("TIM3", "TIM4")]
    return any(abs((b - a + 0x8000) % 0x10000 - 0x8000) > 1 for a, b in zip(before, now, strict=True))


def test_wheels_stop_without_drives(boards):
    started(boards).live(kit_arena(), 20)
    boards.cut = True
    boards.pass_time(0.05)
    assert rolls(boards)
    boards.pass_time(0.23)
    assert not rolls(boards)


def test_button_starts_and_stops_the_brain(boards):
    started(boards)
    boards.press()
    boards.pass_time(0.1)
    said = decoded(frame for _, frame in boards.heard)
    answers = [it.signals for it in said if it.name == "ANSWER"]
    assert [it["opcode"] for it in answers] == [Opcode.START, Opcode.SET, Opcode.STOP]
    assert [it.signals["reason"] for it in said if it.name == "DRIVE"][-1] == Reason.STOP


def next_senses(boards):
    """The signals of those of the next tick."""
    boards.pass_time(0.02)
    return [it.signals for it in decoded(frame for _, frame in boards.heard) if it.name == "SENSES"][-1]


def test_damaged_or_old_drive_moves_no_wheel(boards):
    boards.cut = True
    boards.robot.join(kit_arena().body.kit)
    drive = {"left": 200, "right": 200, "reason": 1, "repeat_count": 0, "eat": 0, "action": 1}
    for _ in range(10):
        senses = next_senses(boards)
        of_now = {**drive, "tick": senses["tick"], "counter": senses["counter"]}
        good = PROTOCOL.encode("DRIVE", of_now)
        boards.body.send(PROTOCOL.encode("DRIVE", {**of_now, "tick": (senses["tick"] - 2) % TICK_SPAN}))
        boards.body.send(Frame(good.id, bytes([good.data[0] ^ 1]) + good.data[1:]))
        assert not rolls(boards)
    for _ in range(10):
        senses = next_senses(boards)
        boards.body.send(PROTOCOL.encode("DRIVE", {**drive, "tick": senses["tick"], "counter": senses["counter"]}))
    assert rolls(boards)
