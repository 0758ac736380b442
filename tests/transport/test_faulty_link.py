"""A link with faults: each does to the frames what its name says, and a recorded one does it again."""

import tracemalloc
from collections import deque
from random import Random

import pytest

from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.forgery import forgers
from host_sim.protocol.generated import NOTHING_SENSED, Opcode
from host_sim.transport.faulty_link import FaultyLink, Schedule
from host_sim.transport.link import VirtualClock
from host_sim.transport.rule import Rule

PROTOCOL = Protocol()
SENT = [Frame(0x123, bytes([number] * 8)) for number in range(20)]


class Mirror:
    """A far end that sends back what it receives."""

    def __init__(self) -> None:
        self.heard: list[Frame] = []
        self.waiting: deque[Frame] = deque()

    def send(self, frame: Frame) -> None:
        self.heard.append(frame)
        self.waiting.append(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        assert timeout_s == 0.0  # with a virtual clock nobody waits
        return self.waiting.popleft() if self.waiting else None

    def close(self) -> None:
        self.waiting.clear()


class Journey:
    """Frames that went through a link with faults: what the far end heard, and what came back, with its time."""

    def __init__(self, *rules: str | Rule, seed: int = 1) -> None:
        self.mirror, self.clock = Mirror(), VirtualClock()
        parsed = [rule if isinstance(rule, Rule) else Rule.parse(rule) for rule in rules]
        self.link = FaultyLink(self.mirror, Schedule(parsed, seed, forgers(PROTOCOL)), self.clock)
        self.back: list[Frame] = []
        self.times: list[float] = []
        for frame in SENT:
            self.link.send(frame)
            self._listen(0.01)
        self._listen(1.0)

    def _listen(self, seconds: float) -> None:
        while (frame := self.link.receive(seconds)) is not None:
            self.back.append(frame)
            self.times.append(self.clock.now())

    @property
    def heard(self) -> list[Frame]:
        return self.mirror.heard


class Flood(Mirror):
    """A far end that always has one more frame, for as long as anybody could wait."""

    def receive(self, _: float) -> Frame | None:
        self.heard.append(SENT[0])
        assert len(self.heard) < 100_000
        return SENT[0]


def test_receive_times_out_during_endless_lost_frames():
    link = FaultyLink(Flood(), Schedule([Rule.parse("drop:100%/from")], 1, forgers(PROTOCOL)))

    assert link.receive(0.001) is None


def test_frames_pass_unchanged_without_a_rule():
    journey = Journey()

    assert (journey.heard, journey.back) == (SENT, SENT)


HEARD = {
    "drop@3-5/to": SENT[:2] + SENT[5:],
    "duplicate:2@4/to": SENT[:3] + [SENT[3]] * 3 + SENT[4:],
    "reorder:2@4/to": [*SENT[:3], SENT[4], SENT[5], SENT[3], *SENT[6:]],
    "reorder:5@20/to": SENT,  # the last frame still arrives
    "truncate:3@4/to": [*SENT[:3], Frame(0x123, SENT[3].data[:3]), *SENT[4:]],
}


@pytest.mark.parametrize("rule", HEARD)
def test_fault_of_named_frames_changes_only_these(rule):
    assert Journey(rule).heard == HEARD[rule]


def test_drop_by_chance_hits_both_directions():
    journey = Journey("drop:30%")

    assert len(SENT) > len(journey.heard) > len(journey.back) > 0


def test_delay_makes_a_frame_late():
    prompt, late = Journey(), Journey("delay:50ms@20/from")

    assert late.back == SENT
    assert late.times[-1] - prompt.times[-1] == pytest.approx(0.05, abs=0.001)


def test_delay_range_changes_the_order_and_loses_no_frame():
    journey = Journey("delay:5-300ms/to")

    assert sorted(journey.heard) == SENT
    assert journey.heard != SENT


def test_corrupt_changes_one_bit():
    journey = Journey("corrupt@4/to")

    (changed,) = set(journey.heard) - set(SENT)
    assert (int.from_bytes(changed.data, "big") ^ int.from_bytes(SENT[3].data, "big")).bit_count() == 1


def test_flood_adds_foreign_frames():
    journey = Journey("flood:50@4/to")

    foreign = [frame for frame in journey.heard if frame not in SENT]
    assert len(foreign) == 50
    assert [frame for frame in journey.heard if frame in SENT] == SENT
    assert {len(frame.data) for frame in foreign} == set(range(9))


def test_forge_sends_a_command_in_the_name_of_the_client():
    journey = Journey("forge:stop@4/to")

    (forged,) = set(journey.heard) - set(SENT)
    decoded = PROTOCOL.decode(forged)
    assert decoded is not None
    assert (decoded.name, decoded.signals["opcode"]) == ("COMMAND", Opcode.STOP)


def test_forged_senses_are_those_of_the_next_tick():
    (forger, sent) = forgers(PROTOCOL)("SENSES"), PROTOCOL.encode_senses(NOTHING_SENSED._replace(tick=255), 14)

    forger.hear(sent)

    signals = PROTOCOL.decode(forger.forge(Random(1))).signals
    assert (signals["tick"], signals["counter"]) == (0, 0)


EVERYTHING = (
    "drop:20%",
    "duplicate:20%",
    "reorder:20%",
    "delay:20%:0-300ms",
    "corrupt:20%",
    "truncate:20%",
    "flood:9%",
)


def test_same_seed_injects_the_same_faults():
    first, again, other = Journey(*EVERYTHING), Journey(*EVERYTHING), Journey(*EVERYTHING, seed=2)

    assert (first.heard, first.back, first.times) == (again.heard, again.back, again.times)
    assert first.heard != other.heard


def test_recorded_faults_can_be_replayed():
    first = Journey(*EVERYTHING)

    again = Journey(*(Rule.parse(str(rule)) for rule in first.link.schedule.struck))

    assert (again.heard, again.back, again.times) == (first.heard, first.back, first.times)
    assert first.link.schedule.count == again.link.schedule.count > 20


def test_recorded_fault_takes_under_50_bytes():
    schedule = Schedule([Rule.parse("drop:50%"), Rule.parse("duplicate:50%")], 1, forgers(PROTOCOL))
    tracemalloc.start()

    for _ in range(1000):
        schedule.passing(SENT[0], "to")

    size, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert schedule.count > 900
    assert size < 50 * schedule.count


def test_fault_record_is_limited_and_the_count_is_not(monkeypatch):
    monkeypatch.setattr("host_sim.transport.faulty_link.RECORD_MAX", 5)

    link = Journey("drop:60%").link

    assert len(link.schedule.struck) == 5 < link.schedule.count


def test_fault_hits_its_frame_whatever_other_rules_do():
    alone, among_others = Journey("corrupt@9/to"), Journey("drop@2/to", "corrupt@9/to")

    assert alone.heard[8:] == among_others.heard[7:]


def test_babble_inserts_frames_before_the_frame():
    journey = Journey(Rule.parse("babble:3@1/to"))

    assert len(journey.heard) == len(SENT) + 3
    assert [frame for frame in journey.heard if frame in SENT] != []


def test_close_closes_the_underlying_link():
    mirror = Mirror()
    mirror.waiting.append(SENT[0])

    FaultyLink(mirror, Schedule([], 1, forgers(PROTOCOL)), VirtualClock()).close()

    assert not mirror.waiting
