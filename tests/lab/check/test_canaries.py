"""A robot with one defect fails the sentence that it breaks, and no other."""

import pytest

from host_sim.lab.check.checking import check_robot
from host_sim.lab.check.registry import CHECKS
from tests.lab.check.virtual import example, one_for_all, virtual

CANARIES = {}


def breaks(*numbers):
    def note(robot):
        for number in numbers:
            CANARIES[number] = robot
        return robot

    return note


class Robot(example.Robot):
    """The example, whose words can be meddled with one by one."""

    def step(self, frames, now_ms):
        return [said for frame in super().step(frames, now_ms) for said in self.meddle(*frame)]

    def meddle(self, frame_id, data):
        return [(frame_id, data)]

    def again(self, frame_id, data):
        """A frame with its CRC made right."""
        return [(frame_id, bytes([example.crc8(frame_id, data)]) + data[1:])]


def meddling(message, meddle):
    """A robot whose frames of one message are changed by a function of the frame as a word."""

    class Meddler(Robot):
        def meddle(self, frame_id, data):
            if frame_id != message:
                return [(frame_id, data)]
            word = meddle(int.from_bytes(data, "little"))
            return self.again(frame_id, (word & (1 << 8 * len(data)) - 1).to_bytes(len(data), "little"))

    return Meddler


@breaks("T1")
class SaysNothingAtPowerUp(Robot):
    def power_up(self, now_ms):
        super().power_up(now_ms)
        return []


class MeddledStop(Robot):
    def obey(self, data, word, now_ms):
        said = super().obey(data, word, now_ms)
        return self.reordered(said) if word >> 12 & 15 == example.STOP else said


@breaks("T2")
class AnswersLast(MeddledStop):
    def reordered(self, said):
        return [*said[1:-1], said[0], said[-1]]


@breaks("T3")
class ReportsNoBoot(Robot):
    def report(self, message, silent=0):
        return [] if message == example.BOOT and self.command else super().report(message, silent)


@breaks("T4")
class TellsHealthFirst(MeddledStop):
    def reordered(self, said):
        return [said[0], said[-2], *said[1:-2], said[-1]]


@breaks("T5")
class StopsWithoutDrive(MeddledStop):
    def reordered(self, said):
        return said[:-1]


CANARIES["T6"] = meddling(example.HEARTBEAT, lambda word: word ^ 1 << 50)


class Obeying(Robot):
    """Carries commands out in a way of its own."""

    def carry_out(self, opcode, word):
        return self.changed(opcode, word, super().carry_out(opcode, word))


@breaks("T7")
class TakesAnyProfile(Obeying):
    def changed(self, _opcode, _word, told):
        return (example.DONE, 0) if told[0] == example.UNKNOWN_PROFILE else told


@breaks("T8")
class WantsWhatThereIsNot(Obeying):
    def changed(self, opcode, _word, told):
        return (told[0], 2) if opcode == example.START else told


@breaks("T14")
class CountsSecondsForItself(Robot):
    def carry_out(self, opcode, word):
        before = self.part_ms
        told = super().carry_out(opcode, word)
        self.part_ms = before
        return told


@breaks("ANSWER.value")
class GetsWrongValues(Obeying):
    def changed(self, opcode, word, told):
        return (told[0], told[1] + 1) if opcode == example.GET and word >> 24 & 255 == 5 else told


class Driving(Robot):
    """Drives in a way of its own."""

    def say_drive(self, reason=0, left=0, right=0):
        (frame,) = super().say_drive(reason, left, right)
        return self.again(frame[0], self.changed(frame[1], reason))


@breaks("T9")
class CountsTo64(Driving):
    def changed(self, data, _reason):
        return (int.from_bytes(data, "little") & ~(192 << 12)).to_bytes(8, "little")


@breaks("P2")
class CountsForItself(Driving):
    def changed(self, data, _reason):
        return bytes([data[0], data[1] & 0xF0 | 3]) + data[2:]


@breaks("S1")
class RollsOnInSilence(Driving):
    def changed(self, data, reason):
        return data if reason != 8 else data[:3] + bytes([20]) + data[4:]


@breaks("DRIVE.reason")
class HasNoReason(Driving):
    def changed(self, data, reason):
        return data if reason != 5 else data[:2] + bytes([data[2] | 0xF0]) + data[3:]


class Sensing(Robot):
    def sense(self, data, word, now_ms):
        return self.changed(super().sense, data, word, now_ms)


@breaks("T10")
class BeginsEarly(Sensing):
    def changed(self, sense, data, word, now_ms):
        return [] if not self.knows_tick and word >> 12 & 255 > 150 else sense(data, word, now_ms)


@breaks("T11")
class HasNoHealth(Sensing):
    def changed(self, sense, *senses):
        return [frame for frame in sense(*senses) if frame[0] != example.HEALTH]


@breaks("T12")
class TellsFaultsLate(Sensing):
    def changed(self, sense, *senses):
        return sorted(sense(*senses), key=lambda frame: frame[0] == example.EMERGENCY)


@breaks("T13")
class DrivesFirst(Sensing):
    def changed(self, sense, *senses):
        return sorted(sense(*senses), key=lambda frame: frame[0] == example.HEALTH)


@breaks("L2")
class SkipsTicksInLockstep(Sensing):
    def changed(self, sense, data, word, now_ms):
        if self.lockstep and self.knows_tick and (word >> 12) - self.tick & 255 == 2:
            self.knows_tick = False
        return sense(data, word, now_ms)


@breaks("L3")
class ActsAgain(Sensing):
    def changed(self, sense, data, word, now_ms):
        if self.knows_tick and word >> 12 & 255 == self.tick and self.lockstep:
            self.action = (self.action + 1) % 128
            return self.say_drive(1, 200, 200)
        return sense(data, word, now_ms)


@breaks("P4")
class TakesTicksFromAfar(Sensing):
    def changed(self, sense, data, word, now_ms):
        if not self.lockstep and (word >> 12) - self.tick & 255 == 15:
            self.knows_tick = False
        return sense(data, word, now_ms)


@breaks("P3")
class TakesShortFrames(Robot):
    def hear(self, frame_id, data, now_ms):
        if frame_id == example.SENSES and len(data) == 7:
            return self.drive
        return super().hear(frame_id, data, now_ms)


@breaks("B1")
class SpeaksInAnothersName(Robot):
    def meddle(self, frame_id, data):
        return [(frame_id, data)] + [(0x7FF, data)] * (frame_id == example.HEALTH)


@breaks("B3")
class HasALongBoot(Robot):
    def meddle(self, frame_id, data):
        return self.again(frame_id, data.ljust(8, b"\0")) if frame_id == example.BOOT else [(frame_id, data)]


CANARIES["B7"] = meddling(example.EMERGENCY, lambda word: word | 1 << 60)
CANARIES["O6"] = meddling(example.HEARTBEAT, lambda word: word & ~(255 << 24))
CANARIES["BOOT.reset_cause"] = meddling(example.BOOT, lambda word: word | 7 << 12)


@breaks("B8")
class HasAWrongCrc(Robot):
    def meddle(self, frame_id, data):
        return [(frame_id, b"\0" + data[1:]) if frame_id == example.HEALTH else (frame_id, data)]


@breaks("P1")
class DoesNotCount(Robot):
    def report(self, message, silent=0):
        self.counters.pop(example.HEALTH, None)
        return super().report(message, silent)


class Commanded(Robot):
    def obey(self, data, word, now_ms):
        return self.changed(super().obey, data, word, now_ms)


@breaks("P5")
class TakesOldCommands(Commanded):
    def changed(self, obey, data, word, now_ms):
        if self.command and (data[1] - self.command[1]) % 16 and ((data[1] & 15) - (self.command[1] & 15)) % 15 == 8:
            self.hears_owner = False
        said = obey(data, word, now_ms)
        self.hears_owner = bool(self.owner)
        return said


@breaks("P8")
class ObeysWhatItRefuses(Commanded):
    def changed(self, obey, data, word, now_ms):
        if self.owner and data[2] != self.owner and data[1] >> 4 == example.SET:
            self.carry_out(example.SET, word)
        return obey(data, word, now_ms)


@breaks("L4")
class ObeysTwice(Commanded):
    def changed(self, obey, data, word, now_ms):
        if data == self.command and data[1] >> 4 == example.ERASE:
            self.held = example.binascii.crc_hqx(data[1:], self.held)
        return obey(data, word, now_ms)


@breaks("O1")
class IsFaithful(Commanded):
    last = 0

    def changed(self, obey, data, word, now_ms):
        self.last = self.owner or self.last
        if self.last not in (0, data[2], self.owner) and data[1] >> 4 != example.STOP and not self.silences:
            return self.say_answer(word, example.OWNED)
        return obey(data, word, now_ms)


@breaks("O4")
class ForgetsForAnybody(Commanded):
    def changed(self, obey, data, word, now_ms):
        if data[1] >> 4 == example.ERASE and self.owner:
            self.owner = data[2]
        return obey(data, word, now_ms)


@breaks("O5")
class StopsForItsOwnerOnly(Commanded):
    def changed(self, obey, data, word, now_ms):
        if self.owner not in (0, data[2]) and data[1] >> 4 == example.STOP:
            return self.say_answer(word, example.OWNED)
        return obey(data, word, now_ms)


class Holding(Commanded):
    def changed(self, obey, data, word, now_ms):
        before, had_owner = self.held, self.owner
        said = obey(data, word, now_ms)
        self.held = self.kept(data[1] >> 4, before, had_owner)
        return said


@breaks("H1")
class HoldsNoSettings(Holding):
    def kept(self, opcode, before, _had_owner):
        return before if opcode == example.SET else self.held


@breaks("H3")
class HoldsWhatIsAsked(Holding):
    def kept(self, opcode, before, _had_owner):
        return before ^ 1 if opcode == example.GET else self.held


@breaks("H4")
class HoldsForEver(Holding):
    def kept(self, opcode, before, had_owner):
        return before if opcode == example.STOP and not had_owner else self.held


@breaks("H5")
class HoldsNoMemory(Robot):
    def report(self, message, silent=0):
        cells, self.cells = self.cells, [0] * 8 if message == example.HEALTH else self.cells
        said = super().report(message, silent)
        self.cells = cells
        return said


@breaks("MEMORY")
class LearnsInSilence(Commanded):
    def changed(self, obey, data, word, now_ms):
        counters = dict(self.counters)
        said = obey(data, word, now_ms)
        if data[1] >> 4 != example.WRITE:
            return said
        self.counters = counters
        return said[:1]


class Counting(Robot):
    def count(self, fault, more=1):
        return self.changed(super().count, fault, more)


@breaks("P6")
class HasNoStaleSenses(Counting):
    def changed(self, count, fault, more):
        before = list(self.faults)
        count(fault, more)
        if fault == example.DAMAGED:
            self.faults = before
        return []


@breaks("P7")
class TellsNoFaults(Robot):
    def emergency(self):
        self.news = 0
        return []


@breaks("O8")
class CountsNoTwins(Counting):
    def changed(self, count, fault, more):
        return [] if fault == example.TWIN else count(fault, more)


@breaks("O7")
class IgnoresTwins(Robot):
    def hear(self, frame_id, data, now_ms):
        self.strangers = -9
        return super().hear(frame_id, data, now_ms)


class Silent(Robot):
    def miss_senses(self):
        return self.changed(super().miss_senses())


@breaks("S2")
class SaysEveryOtherSilence(Silent):
    def changed(self, said):
        return [frame for frame in said if frame[0] != example.DRIVE or self.silences % 2]


@breaks("S3")
class IsSilentWhenStopped(Silent):
    def changed(self, said):
        return said if self.running else []


@breaks("S4")
class HasNoHeartbeat(Silent):
    def changed(self, said):
        return [frame for frame in said if frame[0] != example.HEARTBEAT]


@breaks("S5")
class ForgetsInSilence(Silent):
    def changed(self, said):
        self.cells = [0] * 8
        return said


@breaks("L1")
class CountsSilenceInLockstep(Silent):
    def changed(self, said):
        self.count(example.SILENCE, int(self.lockstep))
        return said


@breaks("O2")
class KeepsItsOwner(Silent):
    def changed(self, said):
        self.hears_owner = self.hears_owner or not self.lockstep
        return said


@breaks("O3")
class LosesItsOwner(Silent):
    def changed(self, said):
        self.hears_owner = False
        return said


@breaks("S6")
class AnswersAllThatQueued(Robot):
    def step(self, frames, now_ms):
        if len(frames) > 1:
            self.heard_ms, self.count = now_ms, self.count
        return super().step(frames, now_ms)


def test_a_good_robot_that_is_there_already_passes():
    verdicts = check_robot(one_for_all(example.Robot()), missing=("T1", "S6"))

    assert [verdict for verdict in verdicts if verdict.state == "fails"] == []
    assert {verdict.number for verdict in verdicts if "--robot-command" in verdict.why} == {"T1", "S6"}


def test_every_check_has_a_canary():
    assert sorted(set(CHECKS) - set(CANARIES)) == []


@pytest.mark.parametrize("number", sorted(CANARIES))
def test_a_robot_with_one_defect_fails_that_sentence_and_no_other(number):
    verdicts = check_robot(virtual(CANARIES[number]))

    assert [verdict.number for verdict in verdicts if verdict.state == "fails"] == [number]
