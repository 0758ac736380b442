"""Robots with one defect each, by the sentence of docs/protocol.md that it breaks."""

from tests.lab.check.virtual import example

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


class Obeying(Robot):
    """Carries commands out in a way of its own."""

    def carry_out(self, opcode, word):
        return self.changed(opcode, word, super().carry_out(opcode, word))


class Driving(Robot):
    """Drives in a way of its own."""

    def say_drive(self, reason=0, left=0, right=0):
        (frame,) = super().say_drive(reason, left, right)
        return self.again(frame[0], self.changed(frame[1], reason))


class Sensing(Robot):
    def sense(self, data, word, now_ms):
        return self.changed(super().sense, data, word, now_ms)


class Commanded(Robot):
    def obey(self, data, word, now_ms):
        return self.changed(super().obey, data, word, now_ms)


class Counting(Robot):
    def count(self, fault, more=1):
        return self.changed(super().count, fault, more)


class Silent(Robot):
    def miss_senses(self):
        return self.changed(super().miss_senses())
