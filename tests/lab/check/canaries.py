"""Robots with one defect each, by the sentence of docs/protocol.md that it breaks.

Each is the example with one method replaced by a function, which gets the robot, the method, and its arguments.
"""

from tests.lab.check.virtual import example

CANARIES = {}


class Robot(example.Robot):
    """The example, whose words can be meddled with one by one."""

    def step(self, frames, now_ms):
        return [said for frame in super().step(frames, now_ms) for said in self.meddle(*frame)]

    def meddle(self, frame_id, data):
        return [(frame_id, data)]

    def again(self, frame_id, data):
        """A frame with its CRC made right."""
        return [(frame_id, bytes([example.crc8(frame_id, data)]) + data[1:])]


def breaks(number, method):
    """Notes the robot in which a function is this method."""

    def note(defect):
        def replaced(self, *words, **named):
            return defect(self, getattr(super(robot, self), method), *words, **named)

        robot = CANARIES[number] = type(defect.__name__, (Robot,), {method: replaced})
        return robot

    return note


def meddles(number, message, change):
    """Notes a robot whose frames of a message are changed by a function of the frame as a word."""

    def meddling(self, meddle, frame_id, data):
        if frame_id != message:
            return meddle(frame_id, data)
        word = change(int.from_bytes(data, "little")) & (1 << 8 * len(data)) - 1
        return self.again(frame_id, word.to_bytes(len(data), "little"))

    breaks(number, "meddle")(meddling)


def stops(number, reordered):
    """Notes a robot whose frames after stop are in another order."""

    def stopping(_, obey, data, word, now_ms):
        said = obey(data, word, now_ms)
        return reordered(said) if word >> 12 & 15 == example.STOP else said

    breaks(number, "obey")(stopping)


def drives(number, changed):
    """Notes a robot whose DRIVE is changed by a function of its data and its reason."""

    def driving(self, say_drive, reason=0, left=0, right=0):
        ((frame_id, data),) = say_drive(reason, left, right)
        return self.again(frame_id, changed(data, reason))

    breaks(number, "say_drive")(driving)


def holds(number, kept):
    """Notes a robot whose `held` after a command is a function of it before, after, the opcode, and the old owner."""

    def holding(self, obey, data, word, now_ms):
        before, had_owner = self.held, self.owner
        said = obey(data, word, now_ms)
        self.held = kept(before, self.held, data[1] >> 4, had_owner)
        return said

    breaks(number, "obey")(holding)


def without(message):
    """A function that leaves out the frames of a message."""
    return lambda said: [frame for frame in said if frame[0] != message]


meddles("T6", example.HEARTBEAT, lambda word: word ^ 1 << 50)
meddles("B7", example.EMERGENCY, lambda word: word | 1 << 60)
meddles("O6", example.HEARTBEAT, lambda word: word & ~(255 << 24))
meddles("BOOT.reset_cause", example.BOOT, lambda word: word | 7 << 12)

stops("T2", lambda said: [*said[1:-1], said[0], said[-1]])  # answers last
stops("T4", lambda said: [said[0], said[-2], *said[1:-2], said[-1]])  # tells HEALTH first
stops("T5", lambda said: said[:-1])  # without a DRIVE

drives("T9", lambda data, _: (int.from_bytes(data, "little") & ~(192 << 12)).to_bytes(8, "little"))  # counts to 64
drives("S1", lambda data, reason: data if reason != 8 else data[:3] + bytes([20]) + data[4:])  # rolls on in silence
drives("DRIVE.reason", lambda data, reason: data if reason != 5 else data[:2] + bytes([data[2] | 0xF0]) + data[3:])
drives("P2", lambda data, _: bytes([data[0], data[1] & 0xF0 | 3]) + data[2:])  # counts for itself

holds("H1", lambda before, after, opcode, _: before if opcode == example.SET else after)
holds("H3", lambda before, after, opcode, _: before ^ 1 if opcode == example.GET else after)
holds("H4", lambda before, after, opcode, owner: before if opcode == example.STOP and not owner else after)


@breaks("T1", "power_up")
def says_nothing_at_power_up(_, power_up, now_ms):
    power_up(now_ms)
    return []


@breaks("T3", "report")
def reports_no_boot(self, report, message, silent=0):
    return [] if message == example.BOOT and self.command else report(message, silent)


@breaks("T7", "carry_out")
def takes_any_profile(_, carry_out, opcode, word):
    told = carry_out(opcode, word)
    return (example.DONE, 0) if told[0] == example.UNKNOWN_PROFILE else told


@breaks("T8", "carry_out")
def wants_what_there_is_not(_, carry_out, opcode, word):
    told = carry_out(opcode, word)
    return (told[0], 2) if opcode == example.START else told


@breaks("T14", "carry_out")
def counts_seconds_for_itself(self, carry_out, opcode, word):
    before = self.part_ms
    told = carry_out(opcode, word)
    self.part_ms = before
    return told


@breaks("ANSWER.value", "carry_out")
def gets_wrong_values(_, carry_out, opcode, word):
    told = carry_out(opcode, word)
    return (told[0], told[1] + 1) if opcode == example.GET and word >> 24 & 255 == 5 else told


@breaks("T10", "sense")
def begins_early(self, sense, data, word, now_ms):
    return [] if not self.knows_tick and word >> 12 & 255 > 150 else sense(data, word, now_ms)


@breaks("T11", "sense")
def has_no_health(_, sense, *senses):
    return without(example.HEALTH)(sense(*senses))


@breaks("T12", "sense")
def tells_faults_late(_, sense, *senses):
    return sorted(sense(*senses), key=lambda frame: frame[0] == example.EMERGENCY)


@breaks("T13", "sense")
def drives_first(_, sense, *senses):
    return sorted(sense(*senses), key=lambda frame: frame[0] == example.HEALTH)


@breaks("L2", "sense")
def skips_ticks_in_lockstep(self, sense, data, word, now_ms):
    if self.lockstep and self.knows_tick and (word >> 12) - self.tick & 255 == 2:
        self.knows_tick = False
    return sense(data, word, now_ms)


@breaks("L3", "sense")
def acts_again(self, sense, data, word, now_ms):
    is_again = self.knows_tick and word >> 12 & 255 == self.tick and self.lockstep
    said = sense(data, word, now_ms)
    self.action = (self.action + is_again) % 128
    return self.say_drive(1, 200, 200) if is_again else said


@breaks("P4", "sense")
def takes_ticks_from_afar(self, sense, data, word, now_ms):
    if not self.lockstep and (word >> 12) - self.tick & 255 == 15:
        self.knows_tick = False
    return sense(data, word, now_ms)


@breaks("H6", "sense")
def hears_only_the_first_senses(self, sense, *senses):
    held = self.held
    said = sense(*senses)
    self.held = held
    return said


@breaks("H8", "sense")
def holds_no_senses_of_obstacles(self, sense, data, word, now_ms):
    obeyed = self.obeyed
    said = sense(data, word, now_ms)
    self.obeyed = obeyed if word >> 20 & 31 else self.obeyed
    return said


@breaks("H9", "sense")
def holds_senses_on_its_own_clock(self, sense, *senses):
    said = sense(*senses)
    self.obeyed = self.obeyed or 1
    return said


@breaks("S2", "miss_senses")
def says_every_other_silence(self, miss_senses):
    return [frame for frame in miss_senses() if frame[0] != example.DRIVE or self.silences % 2]


@breaks("S3", "miss_senses")
def is_silent_when_stopped(self, miss_senses):
    said = miss_senses()
    return said if self.running else []


@breaks("S4", "miss_senses")
def has_no_heartbeat(_, miss_senses):
    return without(example.HEARTBEAT)(miss_senses())


@breaks("S5", "miss_senses")
def forgets_in_silence(self, miss_senses):
    said = miss_senses()
    self.cells = [0] * 8
    return said


@breaks("L1", "miss_senses")
def counts_silence_in_lockstep(self, miss_senses):
    said = miss_senses()
    self.count(example.SILENCE, int(self.lockstep))
    return said


@breaks("O2", "miss_senses")
def keeps_its_owner(self, miss_senses):
    said = miss_senses()
    self.hears_owner = self.hears_owner or not self.lockstep
    return said


@breaks("O3", "miss_senses")
def loses_its_owner(self, miss_senses):
    said = miss_senses()
    self.hears_owner = False
    return said


@breaks("S6", "step")
def answers_all_that_queued(self, step, frames, now_ms):
    if len(frames) > 1:
        self.heard_ms = now_ms
    return step(frames, now_ms)


@breaks("L4", "obey")
def obeys_twice(self, obey, data, word, now_ms):
    if data == self.command and data[1] >> 4 == example.ERASE:
        self.held = example.binascii.crc32(data[1:], self.held)
    return obey(data, word, now_ms)


@breaks("MEMORY", "obey")
def learns_in_silence(self, obey, data, word, now_ms):
    counters = dict(self.counters)
    said = obey(data, word, now_ms)
    if data[1] >> 4 != example.WRITE:
        return said
    self.counters = counters
    return said[:1]


@breaks("P5", "obey")
def takes_old_commands(self, obey, data, word, now_ms):
    if self.command and (data[1] - self.command[1]) % 16 and ((data[1] & 15) - (self.command[1] & 15)) % 15 == 8:
        self.hears_owner = False
    said = obey(data, word, now_ms)
    self.hears_owner = bool(self.owner)
    return said


@breaks("P8", "obey")
def obeys_what_it_refuses(self, obey, data, word, now_ms):
    if self.owner and data[2] != self.owner and data[1] >> 4 == example.SET:
        self.carry_out(example.SET, word)
    return obey(data, word, now_ms)


@breaks("O1", "obey")
def is_faithful(self, obey, data, word, now_ms):
    self.last = self.owner or getattr(self, "last", 0)
    if self.last not in (0, data[2], self.owner) and data[1] >> 4 != example.STOP and not self.silences:
        return self.say_answer(word, example.OWNED)
    return obey(data, word, now_ms)


@breaks("O4", "obey")
def forgets_for_anybody(self, obey, data, word, now_ms):
    if data[1] >> 4 == example.ERASE and self.owner:
        self.owner = data[2]
    return obey(data, word, now_ms)


@breaks("O5", "obey")
def stops_for_its_owner_only(self, obey, data, word, now_ms):
    if self.owner not in (0, data[2]) and data[1] >> 4 == example.STOP:
        return self.say_answer(word, example.OWNED)
    return obey(data, word, now_ms)


@breaks("H7", "obey")
def counts_no_commands(self, obey, *words):
    self.opcodes = 0
    return obey(*words)


@breaks("P3", "hear")
def takes_short_frames(self, hear, frame_id, data, now_ms):
    return self.drive if frame_id == example.SENSES and len(data) == 7 else hear(frame_id, data, now_ms)


@breaks("O7", "hear")
def ignores_twins(self, hear, *words):
    self.strangers = -9
    return hear(*words)


@breaks("B1", "meddle")
def speaks_in_anothers_name(_, meddle, frame_id, data):
    return [*meddle(frame_id, data), *[(0x7FF, data)] * (frame_id == example.HEALTH)]


@breaks("B3", "meddle")
def has_a_long_boot(self, meddle, frame_id, data):
    return self.again(frame_id, data.ljust(8, b"\0")) if frame_id == example.BOOT else meddle(frame_id, data)


@breaks("B8", "meddle")
def has_a_wrong_crc(_, meddle, frame_id, data):
    return meddle(frame_id, b"\0" + data[1:] if frame_id == example.HEALTH else data)


@breaks("P1", "report")
def does_not_count(self, report, message, silent=0):
    self.counters.pop(example.HEALTH, None)
    return report(message, silent)


@breaks("H5", "report")
def holds_no_memory(self, report, message, silent=0):
    cells, self.cells = self.cells, [0] * 8 if message == example.HEALTH else self.cells
    said = report(message, silent)
    self.cells = cells
    return said


@breaks("P6", "count")
def has_no_stale_senses(self, count, fault, more=1):
    before = list(self.faults)
    count(fault, more)
    if fault == example.DAMAGED:
        self.faults = before
    return []


@breaks("O8", "count")
def counts_no_twins(_, count, fault, more=1):
    return [] if fault == example.TWIN else count(fault, more)


@breaks("P7", "emergency")
def tells_no_faults(self, _):
    self.news = 0
    return []
