"""Checks of a conversation: stop and its reports, commands, ticks."""

from itertools import pairwise

from host_sim.lab.check.talk import AT_ONCE_S, REPORTS, SECOND, SeenFrame, Talk, damaged, expect, one, sentence
from host_sim.protocol.generated import LAYOUT_HASH, PARAMETERS, Opcode, Result


def _at_rest(seen: SeenFrame) -> bool:
    return seen.signals["left"] == seen.signals["right"] == 0


def _names(heard: list[SeenFrame]) -> list[str]:
    """Names of the robot's messages, except for faults and silence."""
    spoken = [seen for seen in heard if not seen.signals.get("silent")]
    return [seen.name for seen in spoken if seen.name not in ("", "EMERGENCY", "DRIVE") or seen.is_answer]


@sentence("T2")
def _stop_is_answered(talk: Talk) -> None:
    heard = _names(talk.stop())
    expect(heard[:1] == ["ANSWER"], f"the first frame after stop is {heard[0] if heard else 'none'}")


@sentence("T3")
def _stop_brings_all_reports(talk: Talk) -> None:
    heard = talk.stop()
    missing = [name for name in REPORTS if name not in _names(heard)]
    for name, part in (("MEMORY", "half"), ("FAULTS", "page")):
        parts = {seen.signals.get(part) for seen in heard if seen.name == name}
        missing += [f"{name} with {part} {number}" for number in (0, 1) if parts and number not in parts]
    expect(not missing, f"stop brings no {', no '.join(missing)}")


@sentence("T4")
def _health_is_last(talk: Talk) -> None:
    reports = [name for name in _names(talk.stop()) if name in (*REPORTS, "CRASH")]
    expect(reports[-1:] == ["HEALTH"], f"the last report is {reports[-1] if reports else 'none'}")


@sentence("T5")
def _then_a_drive_at_rest(talk: Talk) -> None:
    talk.drive_once()
    heard = talk.stop()
    expect(bool(heard) and heard[-1].is_answer and _at_rest(heard[-1]), "after its reports comes no DRIVE at rest")


@sentence("T6")
def _the_layout_is_told(talk: Talk) -> None:
    layout = one(talk.stop(), "HEARTBEAT").signals["layout"]
    expect(layout == LAYOUT_HASH, f"layout is 0x{layout:04X}, not 0x{LAYOUT_HASH:04X}")


@sentence("T7")
def _each_command_is_answered(talk: Talk) -> None:
    turn, unknown = PARAMETERS["turn_deg"], 15
    cases = [
        (Opcode.START, {"profile": 0, "lockstep": 1, "seed": 1}, Result.DONE),
        (Opcode.SET, {"parameter": turn.number, "value": turn.maximum}, Result.DONE),
        (Opcode.GET, {"wanted": turn.number}, Result.DONE),
        (Opcode.WRITE, {"mask": 14, "byte_1": 1, "byte_2": 1, "byte_3": 1}, Result.DONE),
        (Opcode.FREEZE, {"freeze": 1}, Result.DONE),
        (Opcode.ERASE, {}, Result.DONE),
        (Opcode.REPORT, {}, Result.DONE),
        (Opcode.STOP, {}, Result.DONE),
        (Opcode.RESUME, {}, Result.DONE),
        (Opcode.START, {"profile": 127}, Result.UNKNOWN_PROFILE),
        (Opcode.SET, {"parameter": 255, "value": 1}, Result.UNKNOWN_PARAMETER),
        (Opcode.SET, {"parameter": turn.number, "value": turn.maximum + 1}, Result.OUT_OF_RANGE),
        (unknown, {}, Result.UNKNOWN_COMMAND),
    ]
    for opcode, signals, wanted in cases:
        answer = talk.result(opcode, **signals).signals
        fields = (answer["counter"], answer["opcode"], answer["result"])
        expect(fields == (talk.counter, opcode, wanted), f"ANSWER has counter, opcode and result {fields}")
        talk.hear(AT_ONCE_S / 10)


@sentence("ANSWER.value")
def _get_tells_the_value(talk: Talk) -> None:
    talk.start()
    for name, parameter in PARAMETERS.items():
        answer = talk.result(Opcode.GET, wanted=parameter.number).signals
        fields = (answer["which"], answer["value"])
        expect(fields == (parameter.number, parameter.default), f"get {name} answers which and value {fields}")


@sentence("T8")
def _start_says_whether_it_wants_ranges(talk: Talk) -> None:
    value = talk.result(Opcode.START, lockstep=1).signals["value"]
    expect(value in (0, 1), f"the answer to start has value {value}")


@sentence("T9")
def _senses_are_answered(talk: Talk) -> None:
    talk.start()
    for _ in range(2 * SECOND):
        tick = talk.drive().signals["tick"]
        expect(tick == talk.tick, f"DRIVE has tick {tick}, not {talk.tick}")


@sentence("T10")
def _the_first_tick_may_be_any(talk: Talk) -> None:
    for tick in (200, 7):
        talk.start()
        talk.tick = tick - 1
        talk.drive()


_TIMES = 3


@sentence("T11")
def _reports_come_once_a_second(talk: Talk) -> None:
    talk.start()
    ticks = [_names(talk.step()) for _ in range((_TIMES + 1) * SECOND)]
    crowded = [names for names in ticks if len(set(names) - {"DRIVE", "MEMORY"}) > 1]
    expect(not crowded, f"in one tick come {', '.join(crowded[0]) if crowded else ''}")
    for name in ("HEARTBEAT", "MEMORY", "FAULTS", "HEALTH"):
        at = [tick for tick, names in enumerate(ticks) if name in names]
        expect(
            len(at) >= _TIMES and max(b - a for a, b in pairwise(at)) <= SECOND + len(REPORTS),
            f"{name} comes in the ticks {at} of {len(ticks)}",
        )


def _after_a_fault(talk: Talk) -> list[SeenFrame]:
    talk.drive_once()
    talk.send(damaged(talk.senses(talk.tick + 1)))
    heard = talk.step() + talk.hear(AT_ONCE_S)
    return [seen for seen in heard if seen.name in ("EMERGENCY", "DRIVE")]


@sentence("T14")
def _seconds_begin_with_start(talk: Talk) -> None:
    for ticks in (SECOND // 2, SECOND):
        talk.stop()
        talk.start()
        heard = [_names(talk.step()) for _ in range(ticks)]
    at = [tick for tick, names in enumerate(heard, 1) if "HEARTBEAT" in names]
    expect(at == [SECOND], f"after stop and start, HEARTBEAT comes in the ticks {at} of {len(heard)}")


@sentence("P7")
def _a_fault_is_told_at_once(talk: Talk) -> None:
    emergency = one(_after_a_fault(talk), "EMERGENCY").signals
    kinds = (emergency["kinds"], emergency["first"])
    expect(kinds == (8, 3), f"after damaged SENSES, EMERGENCY has kinds and first {kinds}")


@sentence("T12")
def _an_emergency_comes_before_the_drive(talk: Talk) -> None:
    names = [seen.name for seen in _after_a_fault(talk) if seen.name == "EMERGENCY" or seen.is_answer]
    expect(names[-1:] != ["EMERGENCY"], "EMERGENCY comes after the DRIVE of its tick")


@sentence("T13")
def _a_drive_is_the_last_of_a_tick(talk: Talk) -> None:
    talk.start()
    for _ in range(SECOND + len(REPORTS)):
        talk.step()
        after = [name for name in _names(talk.hear(AT_ONCE_S / 10)) if name != "DRIVE"]
        expect(not after, f"after DRIVE {talk.tick} comes {', '.join(after)}")


@sentence("T1")
def _power_up_brings_boot(talk: Talk) -> None:
    first = next(seen.name for seen in talk.frames if seen.by_robot)
    expect(first == "BOOT", f"the first frame is {first}")
