"""Defects in silence and in lockstep: S1 to S6, L1 to L4."""

from tests.lab.check.canaries.meddled import Commanded, Driving, Robot, Sensing, Silent, breaks
from tests.lab.check.virtual import example


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
