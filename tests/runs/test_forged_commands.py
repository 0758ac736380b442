"""One forged command that the robot obeys: whatever it is and wherever it comes from, the run says so."""

import pytest

from tests.runs.forged import OPCODES, PACES, SAID, forge_on_vcan

IN_BETWEEN = {
    "in this process": ("--bus", "none", "--limit-s", "8", "--fault", "forge:{}@300/to"),
    "socket pair, lockstep": ("--bus", "fd", "--limit-s", "8", "--fault", "forge:{}@300/to"),
    "socket pair, real time": ("--bus", "fd", "--limit-s", "3", "--real-time", "--fault", "forge:{}@100/to"),
}


@pytest.mark.faulty
@pytest.mark.parametrize("opcode", OPCODES)
@pytest.mark.parametrize("way", IN_BETWEEN)
def test_from_in_between(run, opcode, way):
    done = run("--environments", "1", *(word.format(opcode) for word in IN_BETWEEN[way]))

    assert done.code == 1
    assert SAID.get(opcode, "somebody else commands the robot") in done.errors


@pytest.mark.vcan
@pytest.mark.faulty
@pytest.mark.parametrize("pace", PACES)
def test_from_the_bus(tmp_path, pace):
    forge_on_vcan(tmp_path, pace, "set")
