"""Defects of an owner and of what is held: O1 to O8, H1 to H9."""

from tests.lab.check.canaries.meddled import Commanded, Counting, Robot, Sensing, Silent, breaks, meddling
from tests.lab.check.virtual import example

breaks("O6")(meddling(example.HEARTBEAT, lambda word: word & ~(255 << 24)))


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


@breaks("H6")
class HearsOnlyTheFirstSenses(Sensing):
    def changed(self, sense, data, word, now_ms):
        held = self.held
        said = sense(data, word, now_ms)
        self.held = held
        return said


@breaks("H8")
class HoldsNoSensesOfObstacles(Sensing):
    def changed(self, sense, data, word, now_ms):
        obeyed = self.obeyed
        said = sense(data, word, now_ms)
        self.obeyed = obeyed if word >> 20 & 31 else self.obeyed
        return said


@breaks("H9")
class HoldsSensesOnItsOwnClock(Sensing):
    def changed(self, sense, data, word, now_ms):
        said = sense(data, word, now_ms)
        self.obeyed = self.obeyed or 1
        return said


@breaks("H5")
class HoldsNoMemory(Robot):
    def report(self, message, silent=0):
        cells, self.cells = self.cells, [0] * 8 if message == example.HEALTH else self.cells
        said = super().report(message, silent)
        self.cells = cells
        return said


@breaks("H7")
class CountsNoCommands(Commanded):
    def changed(self, obey, data, word, now_ms):
        self.opcodes = 0
        return obey(data, word, now_ms)


@breaks("O8")
class CountsNoTwins(Counting):
    def changed(self, count, fault, more):
        return [] if fault == example.TWIN else count(fault, more)


@breaks("O7")
class IgnoresTwins(Robot):
    def hear(self, frame_id, data, now_ms):
        self.strangers = -9
        return super().hear(frame_id, data, now_ms)


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
