"""docs/protocol.md, generated from `hal/protocol/octet.dbc`; this file, run as a module, prints it."""

import sys
from collections.abc import Iterable, Sequence
from itertools import groupby
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

For those who write a robot, a body or a tool that talks on the bus. `python -m host_sim.report.protocol_page` prints
this page from [`octet.dbc`](../hal/protocol/octet.dbc), which any tool that reads DBC files can use:

```sh
tools/run --environments 1 --limit-s 2 --quiet
head -n 20 out/run.log | .venv/bin/cantools decode --single-line hal/protocol/octet.dbc
```

[`tools/octet dbc`](logs.md#dbc-files) prints a file for nodes other than 1.

## A conversation

What is asked of a robot has a number in brackets; [`tools/octet check`](bench.md#a-robot-of-your-own) checks a robot
against each. [A program in Python](python.md#a-world-of-your-own) has this conversation.

1. At power-up the robot sends BOOT (T1).
2. **stop** (COMMAND). The robot answers with ANSWER (T2), then all its reports: HEARTBEAT, BOOT, both halves of
   MEMORY, both pages of FAULTS, CRASH if it has crashed (T3), and HEALTH, always the last (T4); then a DRIVE at rest
   (T5). HEARTBEAT has the hash of the messages' layout, 0x{layout:04X} for those of this page (T6); the simulator
   rejects a robot with another hash.
3. **start** with profile and seed, then optionally **set** for parameters and **write** for the memory. Each command
   is answered (T7); the answer to **start** says whether the robot wants RANGES (T8).
4. SENSES with tick n; the robot answers DRIVE with tick n (T9). This repeats every 20 ms of robot time. The first
   tick may have any number (T10).
5. The robot sends its other frames of a tick before that tick's DRIVE: MEMORY when it has learned; once a second each
   report, one per tick in the first ticks of the second (T11); EMERGENCY after a fault (T12). DRIVE is always the
   last (T13). Seconds are counted from the **start** of a stopped robot (T14).

## Bytes

Frames are classic CAN data frames with 11-bit identifiers (B1), at 500 kbit/s unless the robot was flashed for
another bit rate (B2), and have exactly the length given in the table (B3). Bit 0 is the lowest bit of byte 0, bit 8
that of byte 1; the first bit of a signal is its lowest (little-endian) (B4). Signals with a negative range are two's
complement (B5). If several signals share bits, `opcode`, `half` or `page` selects which of them is present (B6). Bits
without a signal are 0 (B7).

`crc`, byte 0 of each message, is CRC-8 with polynomial 0x1D, initial value 0 and no final xor, over the low byte of
the identifier, its high byte, and byte 1 to the last byte (B8). For example, **stop** by owner 1 with counter 0 is
`{stop}` for node 1, in the notation of candump.

## Protection

Every message is protected as in AUTOSAR E2E profile 1, with its identifier as Data ID: by its CRC and an alive
counter from 0 to 14 (P1). The counter of SENSES and RANGES advances with the tick, and a DRIVE has that of the SENSES
that it answers (P2). A frame is accepted if its identifier, length and CRC are right (P3) and its tick or counter
advances: up to 14 ticks ahead of the last tick (P4), 1 to 7 ahead of the owner's last command (P5). All other frames
are refused: they are counted in FAULTS (P6), reported at once by EMERGENCY (P7), and change nothing (P8).

## Silence

If no fresh SENSES come for 100 ms, the robot sends a DRIVE at rest with reason **silence** and the last tick that it
received (S1), every 100 ms (S2), even when stopped (S3), and a HEARTBEAT with `silent` set every second (S4). It
keeps its memory and its current action, and continues with the next SENSES (S5). Of the SENSES that queued up
meanwhile, only the newest are used (S6).

## Lockstep

A robot started with `lockstep` follows the sender's clock: silence is then not a fault (L1), and the robot takes the
SENSES of tick n + 1 only after those of tick n (L2). The same SENSES again are answered by the same DRIVE again, and
change nothing (L3). The same holds for a COMMAND, in lockstep or not (L4).

## Owner

**start** makes the sender the robot's owner, until **stop** (O1), or until no SENSES have come for 100 ms (O2) (in
lockstep for a second (O3)). Meanwhile the commands of other senders are refused (O4), except **stop** (O5). HEARTBEAT
names the owner (O6). A robot that hears two DRIVEs or HEARTBEATs with its own identifiers within a second has a twin:
it stops (O7). Each is counted in FAULTS (O8).

## What it was told

Somebody else may send a command in the owner's name, and the robot obeys. So once a second HEALTH reports a check
value: `held` covers all commands that the robot has carried out (H1). Its owner computes the same from the answers
that it got. If SENSES come for the tick that the robot took last, with another CRC, `held` is continued over their
bytes 1 to 7 and no longer matches (H6). One damaged frame in 256 has a valid CRC: in a second in which frames were
damaged, these SENSES may have to come twice (H6).

In lockstep `held` also covers the SENSES that the robot has taken since its **start**, and the DRIVEs that answered
them, except the last (H8). On its own clock the robot may miss some, and on its own pins it senses for itself: there
SENSES are left out (H9).

The check over commands is the lower half of a CRC-32, that of Ethernet and zip (`zlib.crc32` in Python), 0 over
nothing (H2). Each COMMAND carried out, except **get** and **report**, continues it over the frame's bytes 1 to 7
(H3); a **stop** without an owner sets it to 0 (H4). While the robot has no owner, HEALTH continues it over the eight
cells, too (H5). The check over SENSES is another CRC-32, over
their bytes 1 to 7, each combined by XOR with that byte of the DRIVE that answered the SENSES before; the first follow
none (H8). **start**, **resume** and a **stop** without an owner set it to 0 (H8). `held` is both, combined by XOR
(H8). For example, after `{start}` alone, `held` is 0x{held:04X}.

A **start** could be computed whose seed leaves these 16 bits unchanged. So the ANSWER to **stop** has in `value` all
32 bits over the commands before it, and in `which` the sum of their opcodes, modulo 256 (H7).

## Identifiers

Node 1 has the identifiers below; node n, up to {nodes}, adds n - 1. A smaller identifier has priority on the bus. The
tables leave out `crc`, bits 0..7, and a `counter`, bits 8..11, that each message of its kind increments.

"""

_FEW = 2
_PLAIN = "Alive counter: incremented with each message of this kind."
_PARAMETERS = """
## Parameters

**set** changes these until the next **start**. Only [a stand-alone robot](hardware.md#a-stand-alone-robot) has the
`body_` parameters, and it keeps them: `tools/octet calibrate` sets and shows them.

"""
_LOAD = f"""
## Bus load

The worst case, stuff bits and interframe space included; in brackets, for robots that ask for RANGES. A bus whose
regular traffic stays within {COMFORTABLE:.0%} delivers every frame in time. `canbusload`
[measures the load](logs.md#other-programs).

"""


def page() -> str:
    """The text of docs/protocol.md."""
    database = cantools.database.load_file(DBC)
    assert isinstance(database, Database)
    messages = sorted(database.messages, key=lambda message: message.frame_id)
    head = ["| identifier | message | bytes | from |", "|---|---|---|---|"]
    overview = _overview() + "\n".join([*head, *map(_message_row, messages)]) + "\n"
    listed: dict[str, str] = {}
    sections = "".join(_section(message, listed) for message in messages)
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
    head = ["| parameter | number | range | default | meaning |", "|---|---|---|---|---|"]
    rows = [
        f"| {name} | {p.number} | {_with_unit(f'{p.minimum}..{p.maximum}', p.unit)} | {p.default} | {p.comment} |"
        for name, p in (PARAMETERS | BODY_PARAMETERS).items()
    ]
    return _PARAMETERS + "\n".join([*head, *rows]) + "\n"


def _message_row(message: Message) -> str:
    sender = ", ".join(message.senders)
    name = f"[{message.name}](#{message.name.lower()})"
    return f"| 0x{message.frame_id:03X} | {name} | {message.length} | {sender} |"


def _section(message: Message, listed: dict[str, str]) -> str:
    head = ["| signal | bits | range | meaning |", "|---|---|---|---|"]
    signals = sorted(message.signals, key=lambda signal: (signal.start, _multiplexers(signal)))
    shown = [signal for signal in signals if not _is_plain(signal)]
    alike = (list(group) for _, group in groupby(shown, key=lambda it: (it.comment, it.length, _multiplexers(it))))
    rows = [_signal_row(group, message.name, listed) for group in alike]
    return f"\n## {message.name}\n\n{message.comment}\n\n" + "\n".join([*head, *rows]) + "\n"


def _is_plain(signal: Signal) -> bool:
    """Whether the table leaves a signal out, because most messages have it."""
    return signal.name == "crc" or signal.comment == _PLAIN


def _multiplexers(signal: Signal) -> Iterable[int]:
    return signal.multiplexer_ids or ()


def _signal_row(alike: Sequence[Signal], message: str, listed: dict[str, str]) -> str:
    """The row of a signal, or of several that differ only in their place."""
    signal, end = alike[0], alike[-1]
    last = end.start + end.length - 1
    bits = f"{signal.start}..{last}" if last > signal.start else f"{signal.start}"
    meaning = " ".join(filter(None, (signal.comment, _choices(signal, message, listed))))
    name = signal.name if signal is end else f"{signal.name} to {end.name}"
    return f"| {name} | {bits} | {_with_unit(_range(signal), signal.unit or '')} | {meaning} |"


def _choices(signal: Signal, message: str, listed: dict[str, str]) -> str:
    """The words of a signal's numbers, unless its comment explains 1; if on the page already, as a link."""
    if (signal.comment or "").startswith("1: "):
        return ""
    words = [f"{number} {name}" for number, name in (signal.choices or {}).items()]
    if {str(name) for name in (signal.choices or {}).values()} == PARAMETERS.keys() | BODY_PARAMETERS.keys():
        return "[Numbers](#parameters)."
    text = f"{', '.join(words)}." if words else ""
    first = listed.setdefault(text, message)
    return text if first == message or len(words) <= _FEW else f"Numbers as in [{first}](#{first.lower()})."


def _with_unit(span: str, unit: str) -> str:
    return f"{span} x {unit}" if unit[:1].isdigit() else f"{span} {unit}".rstrip()


def _range(signal: Signal) -> str:
    """The range of a signal. cantools reads a range of 0..0 as none: the value table is used then."""
    if signal.minimum is None:
        return f"{min(signal.choices or [0])}..{max(signal.choices or [0])}"
    return f"{signal.minimum}..{signal.maximum}"


if __name__ == "__main__":
    sys.stdout.write(page())
