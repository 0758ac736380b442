"""One forged command that the robot obeys: whatever it is and wherever it comes from, the run says so."""

import subprocess

import pytest

from host_sim.protocol.codec import COUNTERS, Frame, Protocol, counter_of
from host_sim.protocol.generated import Opcode
from tests.runs.support import DEADLINE_S, start_octet

OPCODES = [opcode.name.lower() for opcode in Opcode]
SAID = {"stop": "somebody else stopped node 1"}
IN_BETWEEN = {
    "in this process": ("--bus", "none", "--limit-s", "8", "--fault", "forge:{}@300/to"),
    "socket pair, lockstep": ("--bus", "fd", "--limit-s", "8", "--fault", "forge:{}@300/to"),
    "socket pair, real time": ("--bus", "fd", "--limit-s", "3", "--real-time", "--fault", "forge:{}@100/to"),
}
PACES = {"lockstep": ("--environments", "3"), "real time": ("--environments", "1", "--limit-s", "4", "--real-time")}


@pytest.mark.faulty
@pytest.mark.parametrize("opcode", OPCODES)
@pytest.mark.parametrize("way", IN_BETWEEN)
def test_from_in_between(run, opcode, way):
    done = run("--environments", "1", *(word.format(opcode) for word in IN_BETWEEN[way]))

    assert done.code == 1
    assert SAID.get(opcode, "somebody else commands the robot") in done.errors


def next_command(log: bytes, opcode: str) -> Frame:
    """What somebody who has heard the frames on the bus sends."""
    protocol = Protocol()
    told = [bytes.fromhex(line.split(b"021#")[1].decode()) for line in log.splitlines() if b" 021#" in line][-1]
    counter = (counter_of(Frame(protocol.id_of("COMMAND"), told)) + 1) % COUNTERS
    any_content = {"profile": 1, "lockstep": 1, "seed": 9, "parameter": 0, "value": 90, "half": 1, "mask": 15}
    any_content |= {"byte_0": 1, "byte_1": 2, "byte_2": 1, "byte_3": 2, "freeze": 1, "wanted": 1}
    signals = {"counter": counter, "opcode": Opcode[opcode.upper()], "owner": told[2]}
    return protocol.encode("COMMAND", {**any_content, **signals})


@pytest.mark.vcan
@pytest.mark.faulty
@pytest.mark.parametrize("opcode", OPCODES)
@pytest.mark.parametrize("pace", PACES)
def test_from_the_bus(tmp_path, opcode, pace):
    listening = subprocess.Popen(["candump", "-L", "-n", "200", "vcan0"], stdout=subprocess.PIPE)
    process = start_octet("run", "--out", tmp_path, *PACES[pace], "--quiet", "--bus", "socketcan:vcan0")
    heard, _ = listening.communicate(timeout=DEADLINE_S)

    frame = next_command(heard, opcode)
    subprocess.run(["cansend", "vcan0", f"{frame.id:03X}#{frame.data.hex()}"], check=True)

    _, errors = process.communicate(timeout=DEADLINE_S)
    assert process.returncode == 1
    assert SAID.get(opcode, "somebody else commands the robot") in errors
