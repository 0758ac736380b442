"""A world for the robot that speaks the wire alone: 10 s with something in front of it now and then."""

import socket
import struct
import subprocess

from host_sim.base.paths import BUILD

ROBOT = BUILD / "host/hal/port/posix/octet-robot"
COMMAND, DRIVE, SENSES, ANSWER, HEALTH = 0x021, 0x041, 0x101, 0x141, 0x7C1


def crc8(data):
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc << 1 ^ (0x11D if crc & 0x80 else 0)
    return crc


def frame(identifier, *signals):  # of 8 bytes, from (first bit, value) for each signal that is not 0
    data = sum(value << first for first, value in signals).to_bytes(8, "little")
    crc = crc8(identifier.to_bytes(2, "little") + data[1:])
    return struct.pack("=IB3x8s", identifier, 8, bytes((crc,)) + data[1:])


def receive(wanted):  # the next frame with this identifier, as a number with the frame's bits
    identifier = None
    while identifier != wanted:
        identifier, length, data = struct.unpack("=IB3x8s", ours.recv(16))
        assert data[0] == crc8(identifier.to_bytes(2, "little") + data[1:length])
    return int.from_bytes(data, "little")


ours, its = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
robot = subprocess.Popen([ROBOT, f"fd:{its.fileno()}"], pass_fds=[its.fileno()], stdout=subprocess.DEVNULL)
its.close()
ours.send(frame(COMMAND, (8, 0), (12, 1), (16, 1)))  # counter 0, stop, owner 1
receive(HEALTH)
ours.send(frame(COMMAND, (8, 1), (12, 2), (16, 1), (31, 1), (32, 7)))  # counter 1, start, owner 1, lockstep, seed 7
assert receive(ANSWER) >> 16 & 0xFF == 0, "the robot does not start"

way, reasons = [0.0, 0.0], []  # what each wheel has rolled, in 0.1 mm
for tick in range(500):
    feel = 4 if tick % 250 < 100 else 0  # now and then there is something in front
    left, right = (round(rolled) % 4096 for rolled in way)
    ours.send(frame(SENSES, (8, tick % 15), (12, tick % 256), (20, feel), (40, left), (52, right)))
    drive = receive(DRIVE)
    speeds = [(drive >> first & 0xFFF ^ 0x800) - 0x800 for first in (24, 36)]
    way = [rolled + speed * 0.02 * 10 for rolled, speed in zip(way, speeds, strict=True)]
    reasons.append(drive >> 20 & 0xF)
print(f"{reasons.count(5)} ticks of trials, {reasons.count(4)} of remembered turns")
ours.send(frame(COMMAND, (8, 2), (12, 1), (16, 1)))  # counter 2, stop
robot.terminate()
robot.wait()
