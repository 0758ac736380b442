"""Defects in what single messages say."""

from tests.lab.check.canaries.meddled import Commanded, Counting, Driving, Obeying, Robot, Sensing, breaks, meddling
from tests.lab.check.virtual import example


@breaks("ANSWER.value")
class GetsWrongValues(Obeying):
    def changed(self, opcode, word, told):
        return (told[0], told[1] + 1) if opcode == example.GET and word >> 24 & 255 == 5 else told


@breaks("DRIVE.reason")
class HasNoReason(Driving):
    def changed(self, data, reason):
        return data if reason != 5 else data[:2] + bytes([data[2] | 0xF0]) + data[3:]


breaks("BOOT.reset_cause")(meddling(example.BOOT, lambda word: word | 7 << 12))


@breaks("MEMORY")
class LearnsInSilence(Commanded):
    def changed(self, obey, data, word, now_ms):
        counters = dict(self.counters)
        said = obey(data, word, now_ms)
        if data[1] >> 4 != example.WRITE:
            return said
        self.counters = counters
        return said[:1]


@breaks("P2")
class CountsForItself(Driving):
    def changed(self, data, _reason):
        return bytes([data[0], data[1] & 0xF0 | 3]) + data[2:]


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


breaks("B7")(meddling(example.EMERGENCY, lambda word: word | 1 << 60))


@breaks("B8")
class HasAWrongCrc(Robot):
    def meddle(self, frame_id, data):
        return [(frame_id, b"\0" + data[1:]) if frame_id == example.HEALTH else (frame_id, data)]


@breaks("P1")
class DoesNotCount(Robot):
    def report(self, message, silent=0):
        self.counters.pop(example.HEALTH, None)
        return super().report(message, silent)


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
