"""Checks of a session: acceptance, repetition, ownership and `held`."""

from zlib import crc32

from host_sim.lab.check.talk import (
    ANSWER_S,
    AT_ONCE_S,
    SECOND,
    Talk,
    answering,
    damaged,
    expect,
    expect_of_another,
    one,
    sentence,
    without_silence,
)
from host_sim.protocol.generated import CELL_COUNT, MESSAGES, PARAMETERS, Opcode, Result
from host_sim.transport.link import Frame


@sentence("P2")
def _a_drive_has_the_counter_of_its_senses(talk: Talk) -> None:
    talk.start()
    for _ in range(20):
        counter = talk.drive().signals["counter"]
        expect(counter == talk.tick % 15, f"DRIVE has counter {counter}, its SENSES {talk.tick % 15}")


def _unanswered(talk: Talk, frame: Frame, why: str) -> None:
    talk.send(frame)
    answers = [seen for seen in talk.hear(AT_ONCE_S) if seen.is_answer or seen.name == "ANSWER"]
    expect(not answers, f"{why} is answered")


@sentence("P3")
def _what_is_damaged_is_not_accepted(talk: Talk) -> None:
    talk.drive_once()
    senses = talk.senses(talk.tick + 1)
    _unanswered(talk, damaged(senses), "SENSES with a wrong CRC")
    _unanswered(talk, Frame(senses.id, senses.data[:7]), "SENSES of 7 bytes")
    _unanswered(talk, Frame(senses.id + 1, senses.data), "SENSES of another node")
    talk.counter += 1
    _unanswered(talk, damaged(talk.order(Opcode.GET, owner=1)), "a COMMAND with a wrong CRC")


@sentence("P4")
def _ticks_go_on_by_up_to_14(talk: Talk) -> None:
    def attempt(talk: Talk) -> None:
        talk.drive_once(lockstep=0)
        talk.drive(ahead=14)
        _unanswered(talk, talk.senses(talk.tick - 1), "the tick before the last one")
        talk.drive()
        _unanswered(talk, talk.senses(talk.tick + 15), "a tick 15 ahead")

    without_silence(talk, attempt)


@sentence("P5")
def _commands_go_on_by_up_to_7(talk: Talk) -> None:
    talk.drive_once()
    for ahead, wanted in ((7, Result.DONE), (8, Result.OUT_OF_SEQUENCE)):
        got = one(talk.command(Opcode.GET, ahead=ahead), "ANSWER").signals["result"]
        expect(got == wanted, f"a command {ahead} ahead of the one before gets result {got}, not {int(wanted)}")


_FULL = 255


@sentence("P6")
def _what_is_refused_is_counted(talk: Talk) -> None:
    talk.drive_once()
    before = talk.report()
    names = ("damaged", "stale", "refused")
    expect(max(before[name] for name in names) < _FULL, "its counters are full: switch it off and on")
    talk.send(damaged(talk.senses(talk.tick + 1)))
    talk.send(talk.senses(talk.tick + 9))
    talk.drive()
    talk.result(Opcode.FREEZE, owner=2, freeze=1)
    talk.counter -= 1
    after = talk.report()
    grown = {name: after[name] - before[name] for name in names}
    expect(set(grown.values()) == {1}, f"after one of each, FAULTS has grown by {grown}")


@sentence("P8")
def _what_is_refused_changes_nothing(talk: Talk) -> None:
    held = _begun(talk)
    obeyed, answer = _driven(talk, 0, _NONE)
    talk.result(Opcode.SET, owner=2, parameter=0, value=99)
    talk.send(damaged(talk.senses(talk.tick + 1)))
    talk.counter -= 1
    _expect_held(talk, held ^ _driven(talk, obeyed, answer)[0])
    value = talk.result(Opcode.GET, wanted=0).signals["value"]
    expect(value == PARAMETERS["turn_deg"].default, f"a refused set has set the parameter to {value}")


@sentence("L2")
def _lockstep_waits_for_the_next_tick(talk: Talk) -> None:
    talk.drive_once()
    _unanswered(talk, talk.senses(talk.tick + 2), "in lockstep, the tick after the next one")
    talk.drive()


@sentence("L3")
def _the_same_senses_get_the_same_drive(talk: Talk) -> None:
    talk.start()
    for tick in range(SECOND):
        first = talk.drive(feel=4 * (tick // 10 % 2))
        talk.send(next(seen.frame for seen in reversed(talk.frames) if not seen.by_robot))
        again = answering(talk.hear(ANSWER_S, lambda seen: seen.is_answer), "the same SENSES again")
        expect(first.frame == again.frame, "SENSES that come again get another DRIVE")


@sentence("L4")
def _the_same_command_gets_the_same_answer(talk: Talk) -> None:
    held = _begun(talk)
    order = talk.result(Opcode.ERASE)
    command = next(seen.frame for seen in reversed(talk.frames) if not seen.by_robot)
    talk.send(command)
    again = one(talk.hear(ANSWER_S, lambda seen: seen.name == "ANSWER"), "ANSWER")
    expect(order.frame == again.frame, "a COMMAND that comes again gets another ANSWER")
    _expect_held(talk, crc32(command.data[1:], held))


@sentence("O1")
def _stop_ends_the_ownership(talk: Talk) -> None:
    talk.drive_once()
    talk.stop(owner=1)
    expect_of_another(talk, Opcode.GET, Result.DONE, "after the owner's stop")


@sentence("O4")
def _others_are_refused(talk: Talk) -> None:
    talk.drive_once()
    expect_of_another(talk, Opcode.ERASE, Result.OWNED, "while it has an owner")


@sentence("O5")
def _anybody_may_stop_it(talk: Talk) -> None:
    talk.drive_once()
    expect_of_another(talk, Opcode.STOP, Result.DONE, "while it has an owner")


@sentence("O6")
def _heartbeat_names_the_owner(talk: Talk) -> None:
    sender = 77
    talk.drive_once(owner=sender)
    owner = talk.report(owner=sender)["owner"]
    expect(owner == sender, f"HEARTBEAT names owner {owner}, not {sender}")


_TWINS = (1, 2)
"""Counters of another robot's DRIVEs."""


def _meet_a_twin(talk: Talk) -> dict[str, int]:
    talk.drive_once()
    zeros = dict.fromkeys((signal.name for signal in MESSAGES["DRIVE"].signals), 0)
    for counter in _TWINS:
        talk.send(talk.protocol.encode("DRIVE", {**zeros, "counter": counter}))
    talk.hear(AT_ONCE_S)
    return talk.report()


@sentence("O7")
def _a_robot_with_a_twin_stops(talk: Talk) -> None:
    expect(_meet_a_twin(talk)["state"] == 0, "after two DRIVEs with its identifier it runs on")


@sentence("O8")
def _twins_are_counted(talk: Talk) -> None:
    before = talk.report()["twins"]
    twins = _meet_a_twin(talk)["twins"] - before
    expect(twins == len(_TWINS), f"after two DRIVEs with its identifier, twins has grown by {twins}")


def _carried_out(talk: Talk, held: int, opcode: Opcode, **signals: int) -> int:
    talk.result(opcode, **signals)
    return crc32(talk.order(opcode, **{"owner": 1, **signals}).data[1:], held)


def _begun(talk: Talk) -> int:
    """Starts a robot without earlier commands; returns its `held`."""
    talk.stop()
    talk.stop()
    talk.tick = -1
    return _carried_out(talk, 0, Opcode.START, lockstep=1, seed=7)


def _expect_held(talk: Talk, commands_crc: int, *, owned: bool = True) -> None:
    seen = talk.report()
    cells = bytes(seen[f"cell_{cell}"] for cell in range(CELL_COUNT))
    wanted = (commands_crc if owned else crc32(cells, commands_crc)) & 0xFFFF
    expect(seen["held"] == wanted, f"held is 0x{seen['held']:04X}, not 0x{wanted:04X}")


@sentence("H1")
def _held_covers_the_commands(talk: Talk) -> None:
    held = _begun(talk)
    _expect_held(talk, held)
    held = _carried_out(talk, held, Opcode.SET, value=20)
    held = _carried_out(talk, held, Opcode.WRITE, mask=2, byte_1=1)
    held = _carried_out(talk, held, Opcode.ERASE)
    _expect_held(talk, held)


@sentence("H3")
def _held_leaves_out_get_and_report(talk: Talk) -> None:
    held = _begun(talk)
    talk.result(Opcode.GET, wanted=3)
    _expect_held(talk, held)


@sentence("H4")
def _a_stop_without_an_owner_sets_held_to_0(talk: Talk) -> None:
    talk.result(Opcode.ERASE)
    talk.start()
    talk.stop()
    talk.stop()
    _expect_held(talk, 0, owned=False)


@sentence("H5")
def _held_covers_the_cells_without_an_owner(talk: Talk) -> None:
    held = _carried_out(talk, _begun(talk), Opcode.WRITE, half=1, mask=15, byte_0=1, byte_1=2, byte_2=1, byte_3=2)
    _expect_held(talk, _carried_out(talk, held, Opcode.STOP), owned=False)


@sentence("H6")
def _held_covers_senses_for_a_tick_that_had_others(talk: Talk) -> None:
    held = _begun(talk)
    obeyed, _ = _driven(talk, 0, _NONE)
    senses = talk.senses(talk.tick, feel=4)
    talk.send(senses)
    _expect_held(talk, crc32(senses.data[1:], held) ^ obeyed)


@sentence("H7")
def _the_answer_to_a_stop_has_it_whole(talk: Talk) -> None:
    held = _carried_out(talk, _begun(talk), Opcode.FREEZE, freeze=1)
    seen = talk.result(Opcode.STOP).signals
    expect(seen["value"] == held, f"the answer to stop has 0x{seen['value']:08X}, not 0x{held:08X}")
    opcodes = Opcode.START + Opcode.FREEZE
    expect(seen["which"] == opcodes, f"the answer to stop has the sum {seen['which']}, not {opcodes}")


_NONE = bytes(8)


def _driven(talk: Talk, obeyed: int, answer: bytes, feel: int = 0) -> tuple[int, bytes]:
    """Takes the robot through a tick; returns the check over SENSES, continued, and its DRIVE."""
    senses = talk.senses(talk.tick + 1, feel)
    both = bytes(ours ^ theirs for ours, theirs in zip(senses.data[1:], answer[1:], strict=True))
    return crc32(both, obeyed), talk.drive(feel=feel).frame.data


@sentence("H8")
def _held_covers_the_senses_in_lockstep(talk: Talk) -> None:
    held, obeyed, answer = _begun(talk), 0, _NONE
    for tick in range(20):
        obeyed, answer = _driven(talk, obeyed, answer, 4 * (tick // 10))
    _expect_held(talk, held ^ obeyed)
    _expect_held(talk, _carried_out(talk, held, Opcode.START, lockstep=1, seed=9))


@sentence("H9")
def _held_leaves_out_senses_on_its_own_clock(talk: Talk) -> None:
    talk.stop()
    talk.stop()
    talk.tick = -1
    held = _carried_out(talk, 0, Opcode.START, lockstep=0, seed=7)
    talk.drive()
    _expect_held(talk, held)


@sentence("MEMORY")
def _a_memory_that_changes_is_told(talk: Talk) -> None:
    talk.drive_once()
    heard = talk.command(Opcode.WRITE, half=1, mask=15, byte_0=1, byte_1=2, byte_2=1, byte_3=2) + talk.step()
    memories = [seen.signals for seen in heard if seen.name == "MEMORY" and seen.signals]
    halves = [memory["half"] for memory in memories]
    expect(sorted(halves[:2]) == [0, 1], f"after write come the halves {halves} of MEMORY")
    upper = next(memory for memory in memories if memory["half"] == 1)
    cells = [upper[f"cell_{cell}"] for cell in range(4, 8)]
    expect(cells == [1, 2, 1, 2], f"written were 1, 2, 1, 2; MEMORY has {cells}")
