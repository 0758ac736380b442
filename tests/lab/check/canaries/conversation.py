"""Defects of a conversation: T1 to T14."""

from tests.lab.check.canaries.meddled import Commanded, Driving, Obeying, Robot, Sensing, Silent, breaks, meddling
from tests.lab.check.virtual import example


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


breaks("T6")(meddling(example.HEARTBEAT, lambda word: word ^ 1 << 50))


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


@breaks("T9")
class CountsTo64(Driving):
    def changed(self, data, _reason):
        return (int.from_bytes(data, "little") & ~(192 << 12)).to_bytes(8, "little")


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


@breaks("S1")
class RollsOnInSilence(Driving):
    def changed(self, data, reason):
        return data if reason != 8 else data[:3] + bytes([20]) + data[4:]


@breaks("L2")
class SkipsTicksInLockstep(Sensing):
    def changed(self, sense, data, word, now_ms):
        if self.lockstep and self.knows_tick and (word >> 12) - self.tick & 255 == 2:
            self.knows_tick = False
        return sense(data, word, now_ms)


@breaks("L3")
class ActsAgain(Sensing):
    def changed(self, sense, data, word, now_ms):
        is_again = self.knows_tick and word >> 12 & 255 == self.tick and self.lockstep
        said = sense(data, word, now_ms)
        self.action = (self.action + is_again) % 128
        return self.say_drive(1, 200, 200) if is_again else said


@breaks("L4")
class ObeysTwice(Commanded):
    def changed(self, obey, data, word, now_ms):
        if data == self.command and data[1] >> 4 == example.ERASE:
            self.held = example.binascii.crc32(data[1:], self.held)
        return obey(data, word, now_ms)


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


@breaks("S6")
class AnswersAllThatQueued(Robot):
    def step(self, frames, now_ms):
        if len(frames) > 1:
            self.heard_ms, self.count = now_ms, self.count
        return super().step(frames, now_ms)
