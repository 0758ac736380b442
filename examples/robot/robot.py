#!/usr/bin/env python3
"""A robot written from docs/protocol.md alone: where something is near, it turns; it learns nothing.

CAN_INTERFACE and CAN_CHANNEL name its bus: `octet` and the number of an open socket, or `socketcan` and an interface.
"""

import binascii
import os
import select
import socket
import struct
import sys
import time

COMMAND, DRIVE, SENSES, ANSWER, EMERGENCY, MEMORY, HEARTBEAT, BOOT, FAULTS, HEALTH = (
    *(0x021, 0x041, 0x101, 0x141, 0x161, 0x681, 0x6A1, 0x6C1, 0x781, 0x7C1),
)
LENGTHS = {MEMORY: 6, BOOT: 7}
STOP, START, RESUME, SET, WRITE, ERASE, FREEZE, GET, REPORT = range(1, 10)
DONE, UNKNOWN_COMMAND, UNKNOWN_PROFILE, UNKNOWN_PARAMETER, OUT_OF_RANGE, OWNED, OUT_OF_SEQUENCE = range(7)
SILENCE, MISSED, STALE, DAMAGED, REFUSED, TWIN = 0, 1, 2, 3, 6, 8
WHOLE = [HEARTBEAT, BOOT, MEMORY, FAULTS, HEALTH]
LEAST = (1, 1, 1, 1, 1, 1, 1, 1, 1, 20, 30, 80, 10, 0, 0, 0)
MOST = (180, 180, 250, 90, 90, 250, 254, 180, 180, 250, 250, 250, 100, 1, 255, 1)
DEFAULTS = (10, 45, 12, 2, 10, 150, 10, 150, 60, 200, 180, 160, 20, 0, 0, 0)
SPEED, TICK_MS = 9, 12
CAN_FRAME = struct.Struct("=IB3x8s")  # struct can_frame of Linux


def crc8(frame_id, data):
    crc = 0
    for byte in (frame_id & 0xFF, frame_id >> 8, *data[1:]):
        crc ^= byte
        for _ in range(8):
            crc = crc << 1 ^ (0x11D if crc & 0x80 else 0)
    return crc


class Robot:
    """Frames go in and out as (identifier, data), with the time in ms."""

    def __init__(self, node=1):
        self.node, self.cells, self.parameters = node, [0] * 8, DEFAULTS
        self.running = self.frozen = self.profile = self.lockstep = self.owner = self.opcodes = 0
        self.held = self.obeyed = 0
        self.tick = self.counter = self.part_ms = self.uptime = self.action = self.strangers = 0
        self.knows_tick = self.hears_owner = False
        self.heard_ms, self.silences, self.faults, self.news, self.first = 0, 0, [0] * 11, 0, 0
        self.command, self.senses, self.answer, self.drive, self.due, self.counters = None, None, [], [], [], {}

    def power_up(self, now_ms):
        self.heard_ms = now_ms
        return self.report(BOOT)

    def step(self, frames, now_ms):
        """What it says when it looks at its bus: frames that have come since, and the time."""
        is_late = now_ms - self.heard_ms >= 100 and not self.lockstep
        queued = [frame for frame in frames if frame[0] == SENSES + self.node - 1] if is_late else []
        self.count(STALE, len(queued[:-1]))
        said = [each for frame in frames if frame not in queued[:-1] for each in self.hear(*frame, now_ms)]
        while now_ms - self.heard_ms >= 100 * (self.silences + 1):
            said += self.miss_senses()
        return said

    def miss_senses(self):
        self.silences += 1
        if not self.lockstep:
            self.count(SILENCE, int(self.knows_tick))
            self.knows_tick = False
        self.hears_owner = self.hears_owner and self.lockstep and self.silences < 10
        sign_of_life = self.report(HEARTBEAT, silent=1) if self.silences % 10 == 0 else []
        return self.emergency() + sign_of_life + self.say_drive(reason=8)

    def hear(self, frame_id, data, now_ms):
        message = frame_id - self.node + 1
        if message not in (COMMAND, SENSES, DRIVE, HEARTBEAT):
            return []
        if len(data) != 8 or data[0] != crc8(frame_id, data) or data[1] & 15 == 15:
            return self.count(DAMAGED)
        if message in (COMMAND, SENSES):
            return (self.obey if message == COMMAND else self.sense)(data, int.from_bytes(data, "little"), now_ms)
        self.strangers += 1
        if self.strangers > 1:
            self.running = self.owner = 0
        return self.count(TWIN)

    def sense(self, data, word, now_ms):
        tick, counter, ahead = word >> 12 & 255, data[1] & 15, ((word >> 12) - self.tick) % 256
        if self.knows_tick and not ahead and data != self.senses:
            self.held = binascii.crc32(data[1:], self.held)
        if self.knows_tick and self.lockstep and not ahead and counter == self.counter:
            return self.drive
        is_next = 1 <= ahead <= (1 if self.lockstep else 14) and (counter - self.counter - ahead) % 15 == 0
        if self.knows_tick and not is_next:
            return self.count(STALE)
        self.count(MISSED, ahead - 1 if self.knows_tick else 0)
        if self.lockstep and self.owner:
            answer = self.drive[0][1] if self.knows_tick else bytes(8)
            both = bytes(ours ^ theirs for ours, theirs in zip(answer[1:], data[1:], strict=True))
            self.obeyed = binascii.crc32(both, self.obeyed)
        self.tick, self.counter, self.senses, self.knows_tick, self.hears_owner = tick, counter, data, True, True
        self.heard_ms, self.silences = now_ms, 0
        self.part_ms += self.parameters[TICK_MS]
        if self.part_ms >= 1000:
            self.part_ms, self.uptime, self.strangers = self.part_ms - 1000, self.uptime + 1, 0
            self.due = [HEARTBEAT, MEMORY, FAULTS, HEALTH]
        speed, is_near = self.running * self.parameters[SPEED], word >> 20 & 0b01110
        self.action = (self.action + self.running) % 128
        self.drive = self.say_drive(self.running * (5 if is_near else 1), -speed if is_near else speed, speed)
        return self.emergency() + (self.report(self.due.pop(0)) if self.due else []) + self.drive

    def obey(self, data, word, _now_ms):
        opcode, sender, counter = word >> 12 & 15, data[2], data[1] & 15
        if data == self.command:
            return self.answer
        if self.owner and self.hears_owner and not (opcode == STOP and sender != self.owner):
            if sender != self.owner:
                self.count(REFUSED)
                return self.say_answer(word, OWNED)
            if not 1 <= (counter - (self.command[1] & 15)) % 15 <= 7:
                self.count(STALE)
                return self.say_answer(word, OUT_OF_SEQUENCE)
        had_owner, self.command = self.owner, data
        result, value = self.carry_out(opcode, word)
        self.answer = self.say_answer(word, result, value)
        if result == DONE and opcode not in (GET, REPORT):
            forgets = opcode == STOP and not had_owner
            self.held = 0 if forgets else binascii.crc32(data[1:], self.held)
            self.opcodes = 0 if forgets else self.opcodes + opcode
            self.obeyed = 0 if forgets or opcode in (START, RESUME) else self.obeyed
        self.count(REFUSED, int(result != DONE))
        kinds = {WRITE: [MEMORY], ERASE: [MEMORY], STOP: WHOLE, REPORT: WHOLE}.get(opcode, [])
        told = [frame for kind in kinds for frame in self.report(kind)]
        return self.answer + self.emergency() + told + (self.say_drive() if opcode == STOP else [])

    def carry_out(self, opcode, word):
        which, value = word >> 24 & 255, word >> 32 & 65535
        if opcode == START:
            if which & 127 > 9:
                return UNKNOWN_PROFILE, 0
            self.profile, self.lockstep, self.parameters, self.frozen = which & 127, which >> 7, DEFAULTS, 0
            if not self.running:
                self.part_ms, self.due = 0, []
        if opcode in (START, RESUME):
            self.running, self.owner, self.hears_owner = 1, word >> 16 & 255, True
            self.knows_tick, self.strangers = False, 0
        elif opcode == STOP:
            self.running, self.owner, self.knows_tick = 0, 0, False
        elif opcode in (SET, GET) and which >= len(DEFAULTS):
            return UNKNOWN_PARAMETER, 0
        elif opcode == SET and not LEAST[which] <= value <= MOST[which]:
            return OUT_OF_RANGE, 0
        elif opcode == SET:
            self.parameters = (*self.parameters[:which], value, *self.parameters[which + 1 :])
        elif opcode == WRITE:
            for i in range(4):
                if which >> i & 1:
                    self.cells[4 * (which >> 4 & 1) + i] = word >> 32 + 8 * i & 255
        elif opcode == ERASE:
            self.cells = [0] * 8
        elif opcode == FREEZE:
            self.frozen = which & 1
        elif opcode not in (GET, REPORT):
            return UNKNOWN_COMMAND, 0
        return DONE, {GET: self.parameters[which % 16], STOP: self.held}.get(opcode, 0)

    def count(self, fault, more=1):
        if more:
            self.faults[fault] = min(self.faults[fault] + more, 255)
            self.first, self.news = self.first if self.news else fault, self.news | 1 << fault
        return []

    def say(self, message, *fields, counter=None):
        """A frame; each field is a value and its first bit."""
        if counter is None:
            counter = self.counters[message] = (self.counters.get(message, -1) + 1) % 15
        word, frame_id = counter << 8 | sum(value << start for value, start in fields), message + self.node - 1
        data = word.to_bytes(LENGTHS.get(message, 8), "little")
        return [(frame_id, bytes([crc8(frame_id, data)]) + data[1:])]

    def say_answer(self, word, result, value=0):
        opcode, which = word >> 12 & 15, word >> 24 & 255
        which = {GET: which, STOP: self.opcodes % 256}.get(opcode, 0)
        fields = (opcode, 12), (result, 16), (which, 24), (value, 32)
        return self.say(ANSWER, *fields, counter=word >> 8 & 15)

    def say_drive(self, reason=0, left=0, right=0):
        fields = (self.tick, 12), (reason, 20), (left & 0xFFF, 24), (right & 0xFFF, 36), (self.action, 57)
        return self.say(DRIVE, *fields, counter=self.counter)

    def emergency(self):
        news, self.news = self.news, 0
        fields = (self.first, 12), (self.tick, 16), (news, 24), (sum(self.faults), 40)
        return self.say(EMERGENCY, *fields) if news else []

    def report(self, message, silent=0):
        if message == BOOT:
            return self.say(BOOT, (1, 16))
        if message == HEARTBEAT:
            flags = (self.running, 12), (self.frozen, 13), (self.lockstep, 14), (silent, 15), (self.profile, 16)
            fields = *flags, (self.owner, 24), (self.uptime % 65536, 32), (0x4B13, 48)
            return self.say(HEARTBEAT, *fields, counter=self.counters.get(HEARTBEAT, 0) if silent else None)
        if message == HEALTH:
            held = binascii.crc32(b"" if self.owner else bytes(self.cells), self.held) ^ self.obeyed
            return self.say(HEALTH, (1, 15), (held % 65536, 48))
        split, values = (4, self.cells) if message == MEMORY else (6, self.faults)
        page = self.say(message, *((value, 16 + 8 * i) for i, value in enumerate(values[:split])))
        rest = ((value, 16 + 8 * i) for i, value in enumerate(values[split:]))
        return page + self.say(message, (1, 12), *rest, counter=self.counters[message])


def main():
    channel = os.environ["CAN_CHANNEL"]
    if os.environ["CAN_INTERFACE"] == "octet":
        bus = socket.socket(fileno=int(channel))
    else:
        bus = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        bus.bind((channel,))
    bus.setblocking(False)
    robot = Robot(int(os.environ.get("OCTET_NODE", "1")))
    said = robot.power_up(time.monotonic_ns() // 1_000_000)
    while True:
        for frame_id, data in said:
            bus.send(CAN_FRAME.pack(frame_id, len(data), data))
        select.select([bus], [], [], 0.01)
        frames = []
        while (packed := receive(bus)) is not None:
            frame_id, length, data = CAN_FRAME.unpack(packed)
            frames.append((frame_id, data[:length]))
        said = robot.step(frames, time.monotonic_ns() // 1_000_000)


def receive(bus):
    try:
        return bus.recv(CAN_FRAME.size) or sys.exit()  # nobody is left at the other end
    except BlockingIOError:
        return None


if __name__ == "__main__":
    main()
