"""A heater of somebody else's, a program: it heats while it is asked to, and is off 300 ms after the last request."""

import os
import select
import socket
import struct
import time

REQUEST, STATE, CYCLE_S, LOST_S = 0x130, 0x230, 0.02, 0.3
CAN_FRAME = struct.Struct("=IB3x8s")  # struct can_frame of Linux

if os.environ["CAN_INTERFACE"] == "octet":
    bus = socket.socket(fileno=int(os.environ["CAN_CHANNEL"]))
else:
    bus = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
    bus.bind((os.environ["CAN_CHANNEL"],))
wanted, temperature, heard_s, next_s = 0, 200, 0.0, time.monotonic()
while True:
    if select.select([bus], [], [], max(next_s - time.monotonic(), 0))[0]:
        packed = bus.recv(CAN_FRAME.size)
        if not packed:
            break  # the bench has gone
        can_id, length, data = CAN_FRAME.unpack(packed)
        if can_id == REQUEST and length == 2:
            wanted, heard_s = min(int.from_bytes(data[:2], "little"), 900), time.monotonic()
    if time.monotonic() >= next_s:
        next_s += CYCLE_S
        is_on = temperature < wanted and time.monotonic() - heard_s < LOST_S
        temperature += 2 if is_on else -(temperature > 200)
        data = struct.pack("<HBx", temperature, 100 if is_on else 0)
        bus.send(CAN_FRAME.pack(STATE, len(data), data))
