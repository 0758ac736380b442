"""Checks of silence, which take time."""

from itertools import pairwise
from statistics import median

from host_sim.lab.check.talk import SeenFrame, Talk, expect, expect_of_another, one, sentence, without_silence
from host_sim.protocol.generated import TICK_SPAN, Opcode, Reason, Result

_SILENCE_S, _LATE_S = 0.1, 0.08
"""Time until silence, and permitted delay on a busy machine, s; a robot must never be early."""
_EVEN_S = 0.03
_TRIES = 3
_LONG_S = 1.3
"""A second, with tolerance for a busy machine, s."""


def _is_silence(seen: SeenFrame) -> bool:
    return seen.name == "DRIVE" and seen.signals.get("reason") == Reason.SILENCE


def _silences(talk: Talk, span_s: float) -> list[SeenFrame]:
    return [seen for seen in talk.hear(span_s) if _is_silence(seen)]


def _started(talk: Talk, lockstep: int = 0) -> None:
    """Starts a robot and sends the senses of three ticks, the last of them just now."""

    def attempt(talk: Talk) -> None:
        talk.start(lockstep=lockstep)
        for _ in range(3):
            talk.drive()

    without_silence(talk, attempt)


def _sent_s(talk: Talk) -> float:
    """Time at which the last senses were sent, s."""
    return next(seen.at_s for seen in reversed(talk.frames) if seen.name == "SENSES")


@sentence("S1")
def _silence_stops_the_wheels(talk: Talk) -> None:
    after_s = _LONG_S
    for _ in range(_TRIES):
        _started(talk)
        first = one(talk.hear(_LONG_S, _is_silence), "DRIVE")
        drive, after_s = first.signals, min(after_s, first.at_s - _sent_s(talk))
    expect(drive["reason"] == Reason.SILENCE, "no DRIVE with reason silence comes")
    expect(drive["left"] == drive["right"] == 0, "the DRIVE of silence is not at rest")
    expect(drive["tick"] == talk.tick % TICK_SPAN, f"the DRIVE of silence has tick {drive['tick']}, not {talk.tick}")
    is_timely = _SILENCE_S - 0.005 <= after_s <= _SILENCE_S + _LATE_S
    expect(is_timely, f"the DRIVE of silence comes after {1000 * after_s:.0f} ms")


@sentence("S2")
def _silence_is_said_every_100_ms(talk: Talk) -> None:
    _started(talk)
    at_s = [seen.at_s for seen in _silences(talk, _LONG_S)]
    gaps = [later - sooner for sooner, later in pairwise(at_s)]
    usual_s = median(gaps) if gaps else 0.0
    expect(abs(usual_s - _SILENCE_S) < _EVEN_S, f"{len(at_s)} DRIVEs of silence come, every {1000 * usual_s:.0f} ms")


@sentence("S3")
def _silence_is_said_when_stopped(talk: Talk) -> None:
    talk.stop()
    expect(bool(_silences(talk, 4 * _SILENCE_S)), "a stopped robot says nothing in silence")


@sentence("S4")
def _silence_has_a_heartbeat(talk: Talk) -> None:
    _started(talk)
    heard = talk.hear(2 * _LONG_S)
    at_s = [seen.at_s for seen in heard if seen.name == "HEARTBEAT" and seen.signals.get("silent")]
    gaps = [later - sooner for sooner, later in pairwise(at_s)]
    is_even = bool(gaps) and all(2 - _LONG_S <= gap <= _LONG_S for gap in gaps)
    expect(is_even, f"HEARTBEATs with silent come {', '.join(f'{at:.2f}' for at in at_s) or 'never'} (s)")


@sentence("S5")
def _it_goes_on_after_silence(talk: Talk) -> None:
    talk.result(Opcode.WRITE, half=1, mask=15, byte_0=1, byte_1=2, byte_2=1, byte_3=2)
    _started(talk)
    talk.hear(3 * _SILENCE_S)
    drive = talk.drive(ahead=40)
    expect(drive.signals["tick"] == talk.tick % TICK_SPAN, "after silence, SENSES of another tick get no DRIVE")
    report = talk.report()
    cells = [report[f"cell_{cell}"] for cell in range(4, 8)]
    expect(cells == [1, 2, 1, 2], f"after silence the memory is another: {cells}")


@sentence("S6")
def _of_queued_senses_the_newest_are_used(talk: Talk) -> None:
    assert talk.hang is not None
    _started(talk)
    before = talk.report()
    talk.hang(int(3000 * _SILENCE_S))
    for ahead in (1, 2, 3):
        talk.send(talk.senses(talk.tick + ahead))
    talk.tick += 3
    ticks = [seen.signals["tick"] for seen in talk.hear(5 * _SILENCE_S) if seen.is_answer]
    stale = talk.report()["stale"] - before["stale"]
    expect((ticks, stale) == ([talk.tick], 2), f"of three SENSES that queued up, those answered have ticks {ticks}")


@sentence("L1")
def _in_lockstep_silence_is_no_fault(talk: Talk) -> None:
    _started(talk, lockstep=1)
    before = talk.report()["silences"]
    talk.hear(3 * _SILENCE_S)
    grown = talk.report()["silences"] - before
    expect(not grown, f"in lockstep, {grown} silences are counted")
    talk.drive()


@sentence("O2")
def _silence_ends_the_ownership(talk: Talk) -> None:
    _started(talk)
    talk.hear(2 * _SILENCE_S)
    expect_of_another(talk, Opcode.GET, Result.DONE, "after 200 ms without SENSES")


@sentence("O3")
def _in_lockstep_only_a_second_of_silence_does(talk: Talk) -> None:
    _started(talk, lockstep=1)
    talk.hear(3 * _SILENCE_S)
    expect_of_another(talk, Opcode.GET, Result.OWNED, "in lockstep, after 300 ms")
    talk.hear(_LONG_S)
    expect_of_another(talk, Opcode.GET, Result.DONE, "in lockstep, after 1.6 s")
