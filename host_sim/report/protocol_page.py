"""docs/protocol.md, generated from `hal/protocol/octet.dbc`: `tools/octet protocol > docs/protocol.md`."""

from collections.abc import Iterable
from zlib import crc32

import cantools
from cantools.database.can import Database, Message
from cantools.database.can.signal import Signal

from host_sim.protocol.codec import DBC, NODE_MAX, Frame, Protocol
from host_sim.protocol.generated import LAYOUT_HASH
from host_sim.protocol.words import BODY_PARAMETERS, PARAMETERS
from host_sim.report.bus_load import COMFORTABLE, load_tables

_HEAD = """\
# The wire

`tools/octet protocol` generates this page from [`octet.dbc`](../hal/protocol/octet.dbc), from which the code in C,
Python and JavaScript is generated, too. Any tool that reads DBC files can decode the traffic; `cantools` is in
`.venv/bin`:

```sh
tools/run --environments 1 --limit-s 2 --quiet
head -n 20 out/run.log | .venv/bin/cantools decode --single-line hal/protocol/octet.dbc
```

`octet.dbc` has the identifiers of node 1; [`tools/octet dbc`](logs.md#dbc-files) prints a file for any nodes.

## A conversation

What is asked of a robot has a number in brackets; [`tools/octet check-robot`](bench.md#a-robot-of-your-own) checks a
robot against each of them.

1. At power-up the robot sends BOOT (T1).
2. **stop** (COMMAND). The robot answers with ANSWER (T2), then all its reports: HEARTBEAT, BOOT, both halves of
   MEMORY, both pages of FAULTS, CRASH if it has crashed (T3), and HEALTH, which is always the last of them (T4);
   then a DRIVE at rest (T5). HEARTBEAT has the hash of the messages' layout, 0x{layout:04X} for those of this page
   (T6); the simulator rejects a robot with another hash.
3. **start** with profile and seed, then optionally **set** for parameters and **write** for the memory. Each
   command is answered (T7); the answer to **start** says whether the robot wants RANGES (T8).
4. SENSES with tick n; the robot answers DRIVE with tick n (T9). This repeats every 20 ms of robot time. The first
   tick may have any number (T10).
5. The robot sends its other frames of a tick before that tick's DRIVE: MEMORY when it has learned; once a second each
   report, one per tick in the first ticks of the second (T11); EMERGENCY after a fault (T12). DRIVE is always the
   last (T13). Seconds are counted from the **start** of a stopped robot (T14).

A program that does this is among the [recipes](recipes.md#a-world-of-your-own).

## Bytes

Frames are classic CAN data frames with 11-bit identifiers (B1), at 500 kbit/s unless the robot was flashed for
another bit rate (B2), and have exactly the length given in the table (B3). Bit 0 is the lowest bit of byte 0, bit 8
that of byte 1; the first bit of a signal is its lowest (little-endian) (B4). Signals with a negative range are two's
complement (B5). If several signals share the same bits, `opcode`, `half` or `page` selects which of them is present
(B6). Bits without a signal are 0 (B7).

`crc` is CRC-8 with polynomial 0x1D, initial value 0 and no final xor, over the low byte of the identifier, its high
byte, and byte 1 to the last byte (B8). For example, **stop** by owner 1 with counter 0 is `{stop}` for node 1, in the
notation of candump.

## Protection

Every message is protected as in AUTOSAR E2E profile 1, with its identifier as Data ID: a CRC over all but its own
byte, and an alive counter from 0 to 14 (P1). The counter of SENSES and RANGES advances with the tick, and a DRIVE has
that of the SENSES that it answers (P2). A frame is accepted if its identifier, length and CRC are right (P3) and its
tick or counter advances: up to 14 ticks ahead of the last tick (P4), 1 to 7 ahead of the owner's last command (P5).
All other frames are refused: they are counted in FAULTS (P6), reported at once by EMERGENCY (P7), and change nothing
(P8).

## Silence

If no fresh SENSES come for 100 ms, the robot sends a DRIVE at rest with reason **silence** and the last tick that it
received (S1), every 100 ms (S2), even when it is stopped (S3), and a HEARTBEAT with `silent` set every second (S4).
Its memory and its current action are kept; it continues with the next SENSES (S5). Of the SENSES that queued up
meanwhile, only the newest are used (S6).

## Lockstep

A robot that was started with `lockstep` follows the sender's clock: silence is then not a fault (L1), and the robot
takes the SENSES of tick n + 1 only after those of tick n (L2). The same SENSES again are answered by the same DRIVE
again, and change nothing (L3): on a bus that loses frames, a simulator only needs to repeat. The same holds for a
COMMAND, in lockstep or not (L4).

## Owner

**start** makes the sender the robot's owner, until **stop** (O1), or until no SENSES have come for 100 ms (O2) (in
lockstep for a second (O3)). Meanwhile the commands of other senders are refused (O4), except **stop** (O5). HEARTBEAT
names the owner (O6). A robot that hears two DRIVEs or HEARTBEATs with its own identifiers within a second has a twin:
it stops (O7). Each is counted in FAULTS (O8).

## What it was told

Whoever knows the protocol can send a command in the owner's name, with the next counter, and the robot obeys. So once
a second, in HEALTH, the robot reports a check value: `held` covers all commands that it has carried out (H1). Its
owner computes the same from the answers that it got, and detects a foreign command within a second. If SENSES come
for the tick that the robot took last, with another CRC than those, `held` is continued over their bytes 1 to 7, and
no longer matches the owner's value: somebody else sends SENSES (H6). One damaged frame in 256 has a valid CRC: in a
second in which frames were damaged, these SENSES may have to come twice (H6).

`held` is the lower half of a CRC-32, that of Ethernet and zip (`zlib.crc32` in Python), 0 over nothing (H2). Each
COMMAND that the robot has carried out, except **get** and **report**, continues it over the frame's bytes 1 to 7
(H3); a **stop** without an owner sets it to 0 (H4). While the robot has no owner, HEALTH continues it over the eight
cells, too (H5): so the report that ends a run also proves its memory. For example, after `{start}` alone, `held` is
0x{held:04X}.

Somebody who keeps the robot's answer back could compute a **start** whose seed leaves these 16 bits unchanged. So the
ANSWER to **stop** has more: in `value` all 32 bits over the commands before it, and in `which` the sum of their
opcodes, modulo 256 (H7). The CRC shows a command that replaced another of its kind; the sum shows one too many, or
one of another kind.

The cost on the bus is two bytes, at most 20 bits, per second and robot, and no extra frame.

## Identifiers

Node 1 has the identifiers below; node n, up to {nodes}, adds n - 1. A smaller identifier has priority on the bus.

"""

_PARAMETERS = """
## Parameters

**set** changes these until the next **start**. Only [a stand-alone robot](hardware.md#a-robot-of-its-own) has the
`body_` parameters, and it keeps them: `tools/octet calibrate` sets and shows them.

"""
_LOAD = f"""
## Bus load

Worst-case bus load, stuff bits and interframe space included, as `tools/octet load` computes it from the messages'
lengths and cycle times; in brackets, for robots that ask for RANGES. A bus whose regular traffic stays within
{COMFORTABLE:.0%} delivers every frame in time. [With a log](logs.md#bus-load), the command prints the measured load.

"""


def page() -> str:
    """The text of docs/protocol.md."""
    database = cantools.database.load_file(DBC)
    assert isinstance(database, Database)
    messages = sorted(database.messages, key=lambda message: message.frame_id)
    head = ["| identifier | message | bytes | from |", "| --- | --- | --- | --- |"]
    overview = _overview() + "\n".join([*head, *map(_message_row, messages)]) + "\n"
    sections = "".join(_section(message) for message in messages)
    return overview + sections + _parameters() + _LOAD + load_tables()


def _overview() -> str:
    stop = Protocol().encode("COMMAND", {"counter": 0, "opcode": 1, "owner": 1})
    how = {"profile": 0, "lockstep": 1, "seed": 7}
    start = Protocol().encode("COMMAND", {"counter": 1, "opcode": 2, "owner": 1, **how})
    held = crc32(start.data[1:]) & 0xFFFF
    return _HEAD.format(nodes=NODE_MAX, layout=LAYOUT_HASH, stop=_text(stop), start=_text(start), held=held)


def _text(frame: Frame) -> str:
    return f"{frame.id:03X}#{frame.data.hex().upper()}"


def _parameters() -> str:
    head = ["| parameter | number | range | unit | default | meaning |", "| --- | --- | --- | --- | --- | --- |"]
    rows = [
        f"| {name} | {p.number} | {p.minimum}..{p.maximum} | {p.unit} | {p.default} | {p.comment} |"
        for name, p in (PARAMETERS | BODY_PARAMETERS).items()
    ]
    return _PARAMETERS + "\n".join([*head, *rows]) + "\n"


def _message_row(message: Message) -> str:
    sender = ", ".join(message.senders)
    name = f"[{message.name}](#{message.name.lower()})"
    return f"| 0x{message.frame_id:03X} | {name} | {message.length} | {sender} |"


def _section(message: Message) -> str:
    head = ["| signal | bits | range | unit | meaning |", "| --- | --- | --- | --- | --- |"]
    signals = sorted(message.signals, key=lambda signal: (signal.start, _multiplexers(signal)))
    rows = [_signal_row(signal) for signal in signals]
    return f"\n## {message.name}\n\n{message.comment}\n\n" + "\n".join([*head, *rows]) + "\n"


def _multiplexers(signal: Signal) -> Iterable[int]:
    return signal.multiplexer_ids or ()


def _signal_row(signal: Signal) -> str:
    last = signal.start + signal.length - 1
    bits = f"{signal.start}..{last}" if signal.length > 1 else f"{signal.start}"
    choices = ", ".join(f"{number} {name}" for number, name in (signal.choices or {}).items())
    meaning = f"{signal.comment} {choices}." if choices else f"{signal.comment}"
    return f"| {signal.name} | {bits} | {_range(signal)} | {signal.unit or ''} | {meaning} |"


def _range(signal: Signal) -> str:
    """The range of a signal. cantools reads a range of 0..0 as none: the value table is used then."""
    if signal.minimum is None:
        return f"{min(signal.choices or [0])}..{max(signal.choices or [0])}"
    return f"{signal.minimum}..{signal.maximum}"
