"""Commands that somebody else on the bus sends in the simulator's name."""

import subprocess
from pathlib import Path

from host_sim.protocol.codec import COUNTERS, Frame, Protocol, counter_of
from host_sim.protocol.generated import Opcode
from tests.runs.support import DEADLINE_S, halted, start_octet

OPCODES = [opcode.name.lower() for opcode in Opcode]
SAID = {"stop": "somebody else stopped node 1"}
PACES = {"lockstep": ("--limit-s", "40"), "real time": ("--limit-s", "4", "--real-time")}


def next_command(protocol: Protocol, log: bytes, opcode: str) -> Frame:
    """What somebody who has heard the frames on the bus sends."""
    told = [bytes.fromhex(line.split(b"021#")[1].decode()) for line in log.splitlines() if b" 021#" in line][-1]
    counter = (counter_of(Frame(protocol.id_of("COMMAND"), told)) + 1) % COUNTERS
    any_content = {"profile": 1, "lockstep": 1, "seed": 9, "parameter": 0, "value": 90, "half": 1, "mask": 15}
    any_content |= {"byte_0": 1, "byte_1": 2, "byte_2": 1, "byte_3": 2, "freeze": 1, "wanted": 1}
    signals = {"counter": counter, "opcode": Opcode[opcode.upper()], "owner": told[2]}
    return protocol.encode("COMMAND", {**any_content, **signals})


def forge_on_vcan(out: Path, pace: str, opcode: str) -> None:
    """Forges a command in the midst of a run on vcan0, which has to say so."""
    listening = subprocess.Popen(["candump", "-L", "-n", "200", "vcan0"], stdout=subprocess.PIPE)
    words = ("--environments", "1", *PACES[pace], "--quiet", "--bus", "socketcan:vcan0")
    process = start_octet("run", "--out", out, *words)
    heard, _ = listening.communicate(timeout=DEADLINE_S)

    with halted(process):
        frame = next_command(Protocol(), heard, opcode)
        subprocess.run(["cansend", "vcan0", f"{frame.id:03X}#{frame.data.hex()}"], check=True)

    _, errors = process.communicate(timeout=DEADLINE_S)
    assert process.returncode == 1
    assert SAID.get(opcode, "somebody else commands the robot") in errors
