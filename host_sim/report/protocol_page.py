"""docs/protocol.md, made from `hal/protocol/octet.dbc`: `tools/octet protocol > docs/protocol.md`."""

from collections.abc import Iterable

import cantools
from cantools.database.can import Database, Message
from cantools.database.can.signal import Signal

from host_sim.protocol.codec import CONTROL, DBC, NODE_MAX
from host_sim.protocol.generated import PARAMETERS

_HEAD = """\
# The wire

Made from [`octet.dbc`](../hal/protocol/octet.dbc) by `tools/octet protocol`; the C, Python and JavaScript code comes
from the same file. Any tool that reads DBC files shows the traffic in plain words; `cantools` is in `.venv/bin`:

```sh
tools/run --environments 1 --limit-s 2 --quiet
head -n 20 out/run.log | .venv/bin/cantools decode --single-line hal/protocol/octet.dbc
```

## A conversation

1. **stop** (COMMAND). The robot answers with ANSWER, HEARTBEAT, FAULTS and MEMORY: who it is, how it fares, what it
   knows. HEARTBEAT has the hash of the messages' layout; the simulator talks to no robot with another one.
2. **start** with profile and seed, then perhaps **set** for parameters and **write** for the memory, each answered.
3. SENSES with tick n; the robot answers DRIVE with tick n. And so on, every 20 ms of robot time.
4. A frame of the robot's own that goes with a tick (MEMORY when it has learned, HEARTBEAT and FAULTS once a second)
   comes before that tick's DRIVE: with the DRIVE all has been said.

Nothing fresh for 100 ms: the robot sends a DRIVE with speed 0, reason stop and the last tick that it heard, and
waits. Its memory and the action under way stay; with the next SENSES it goes on. What queued up meanwhile is dropped
but for the newest. With `lockstep` set in the last COMMAND the limit is 10 s: a simulator may take its time.

A frame is taken if its identifier, length and CRC are right, and its tick or counter is news: a tick up to half a
span ahead of the last, a counter that differs from the last. All else is refused, counted in FAULTS, and changes
nothing.

## Identifiers

Node 1 has the identifiers below; node n, up to {nodes}, adds n - 1. The smaller the identifier, the sooner it gets
the bus.

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
