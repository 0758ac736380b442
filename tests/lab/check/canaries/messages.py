"""Defects in what single messages say."""

from tests.lab.check.canaries.meddled import Commanded, Driving, Obeying, breaks, meddling
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
