"""What a robot takes from others is what the oracle says, for each profile and memories at random."""

import random

import pytest

from host_sim.protocol.generated import MEMORY_KINDS, PROFILES, TICK_SPAN, MemoryKind
from tests.firmware.memory.memories import random_memory
from tests.firmware.octet_c import load
from tests.firmware.oracles.sharing import taught

FFI, C = load()
CASES = 400
TICKS_A_SECOND = 50


def rolled(odometer: int, mm_s: int) -> int:
    """An odometer after a tick."""
    return (odometer + mm_s * C.ODOMETER_COUNTS_PER_MM // TICKS_A_SECOND) % C.ODOMETER_SPAN


class SharingRobot:
    """A robot whose way is always clear, so that it learns nothing by itself."""

    def __init__(self, profile: str) -> None:
        self._robot, self._in, self._out = (FFI.new(f"struct {name} *") for name in ("robot", "input", "output"))
        C.robot_init(self._robot, 1)
        self._command(C.OPCODE_START, PROFILES[profile], 1)
        self._command(C.OPCODE_SET, C.SHARE, 1)
        self.pass_second()

    @property
    def brain(self):
        return self._robot.brain

    def pass_second(self) -> None:
        """To the tick in which the second is full, on wheels that obey."""
        senses, drive, self._out.has_report = self._in.senses, self._out.drive, False
        while not self._out.has_report:
            C.robot_respond(self._robot, C.INPUT_SENSES, self._in, self._out)
            senses.tick = (senses.tick + 1) % TICK_SPAN
            senses.odometer_left = rolled(senses.odometer_left, drive.left_mm_s)
            senses.odometer_right = rolled(senses.odometer_right, drive.right_mm_s)

    def hear(self, half: int, cells: bytes) -> None:
        self._in.peer.upper, self._in.peer.cell = bool(half), cells
        C.robot_respond(self._robot, C.INPUT_PEER, self._in, self._out)

    def _command(self, opcode: int, which: int, value: int) -> None:
        self._in.command.opcode, self._in.command.which, self._in.command.value = opcode, which, value
        C.robot_respond(self._robot, C.INPUT_COMMAND, self._in, self._out)


@pytest.mark.parametrize("profile", PROFILES)
def test_what_is_taken_is_what_the_oracle_says(profile):
    dice, robot, taken = random.Random(1), SharingRobot(profile), 0
    cells = FFI.buffer(robot.brain.memory.cell)
    for _ in range(CASES):
        # Given a memory, and others that were heard in any order
        cells[:] = memory = random_memory(MEMORY_KINDS[profile], dice)
        robot.brain.unlearned = dice.randrange(0, 256, 2)
        kinds = dice.choices([MemoryKind.SIDES, MemoryKind.CONFIDENCE], k=dice.choice([0, 1, 2, 3, 7, 30]))
        others = [random_memory(kind, dice) for kind in kinds]
        halves = [(half, other[4 * half : 4 * half + 4]) for other in others for half in range(2)]
        for half, heard in dice.sample(halves, len(halves)):
            robot.hear(half, heard)
        # When the second is over
        robot.pass_second()
        # Then it knows what the oracle says
        expected = taught(profile, memory, robot.brain.unlearned, others)
        assert cells[:] == bytes(expected)
        taken += bytes(expected) != memory
    assert bool(taken) == (profile not in {"fixed", "never", "five"})
