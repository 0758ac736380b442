"""docs/protocol.md, generated from `hal/protocol/octet.dbc`: `tools/octet protocol > docs/protocol.md`."""

from collections.abc import Iterable

import cantools
from cantools.database.can import Database, Message
from cantools.database.can.signal import Signal

from host_sim.protocol.codec import CONTROL, DBC, NODE_MAX
from host_sim.protocol.generated import PARAMETERS

_HEAD = """\
# The wire

Generated from [`octet.dbc`](../hal/protocol/octet.dbc) by `tools/octet protocol`, as is the code in C, Python and
JavaScript. Any tool that reads DBC files can decode the traffic; `cantools` is in `.venv/bin`:

```sh
tools/run --environments 1 --limit-s 2 --quiet
head -n 20 out/run.log | .venv/bin/cantools decode --single-line hal/protocol/octet.dbc
```

## A conversation

1. **stop** (COMMAND). The robot answers with ANSWER, HEARTBEAT, FAULTS and MEMORY: its identity, its fault counters
   and its memory. HEARTBEAT has the hash of the messages' layout; the simulator rejects a robot with another hash.
2. **start** with profile and seed, then optionally **set** for parameters and **write** for the memory. Each command
   is answered.
3. SENSES with tick n; the robot answers DRIVE with tick n. This repeats every 20 ms of robot time.
4. The robot's other frames of a tick (MEMORY when it has learned, HEARTBEAT and FAULTS once a second) come before
   that tick's DRIVE: DRIVE is always the last.

If nothing fresh comes for 100 ms, the robot sends a DRIVE with speed 0, reason stop and the last tick that it
received, and waits. Its memory and its current action stay; it continues with the next SENSES. Of the SENSES that
queued up meanwhile, only the newest are used. With `lockstep` set in the last COMMAND the limit is 10 s, so that a
simulator may take its time.

A frame is accepted if its identifier, length and CRC are right, and its tick or counter is new: a tick up to half
the range ahead of the last one, a counter that differs from the last one. All other frames are refused: they are
counted in FAULTS, and change nothing.

## Identifiers

Node 1 has the identifiers below; node n, up to {nodes}, adds n - 1. A smaller identifier has priority on the bus.

"""


def page() -> str:
    """The text of docs/protocol.md."""
    database = cantools.database.load_file(DBC)
    assert isinstance(database, Database)
    messages = sorted(database.messages, key=lambda message: message.frame_id)
    rows = [_message_row(message) for message in messages]
    head = ["| identifier | message | bytes | from | protected |", "| --- | --- | --- | --- | --- |"]
    overview = _HEAD.format(nodes=NODE_MAX) + "\n".join([*head, *rows]) + "\n"
    return overview + "".join(_section(message) for message in messages) + _parameters()


def _parameters() -> str:
    head = ["| parameter | number | range | unit | default | meaning |", "| --- | --- | --- | --- | --- | --- |"]
    rows = [
        f"| {name} | {p.number} | {p.minimum}..{p.maximum} | {p.unit} | {p.default} | {p.comment} |"
        for name, p in PARAMETERS.items()
    ]
    return "\n## Parameters\n\nWhat **set** changes, until the next **start**.\n\n" + "\n".join([*head, *rows]) + "\n"


def _message_row(message: Message) -> str:
    protected = "counter, CRC-8" if message.name == "COMMAND" else "tick, CRC-8"
    if message.name == "ANSWER":
        protected = "CRC-8"
    sender = ", ".join(message.senders)
    name = f"[{message.name}](#{message.name.lower()})"
    return f"| 0x{message.frame_id:03X} | {name} | {message.length} | {sender} | {_if_control(message, protected)} |"


def _if_control(message: Message, text: str) -> str:
    return text if message.name in CONTROL else ""


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
    """The range of a signal. cantools reads a range of 0..0 as none: the value table gives it then."""
    if signal.minimum is None:
        return f"{min(signal.choices or [0])}..{max(signal.choices or [0])}"
    return f"{signal.minimum}..{signal.maximum}"
