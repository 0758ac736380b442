"""Told against driven speed on the emulated bridge, with motors of any inductance, in both directions.

`python -m tests.image.test_motor_drive` prints the table.
"""

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from host_sim.emulator.bridge import Winding
from host_sim.protocol.codec import COUNTERS, Protocol
from host_sim.protocol.generated import TICK_SPAN, Reason
from host_sim.world.arena import Arena
from host_sim.world.body_kinds import body_kind
from host_sim.world.geometry import SimParams
from host_sim.world.layouts import generate
from tests.image.two_boards import TwoBoards

ROOT = Path(__file__).resolve().parents[2]
INDUCTANCES_MH = (0.3, 1.0, 2.0)
SPEEDS_MM_S = (60, 100, 150, 200)
SETTLING_TICKS, TICKS, TICK_S = 40, 50, 0.02
COUNT_MM = 0.0916
_PROTOCOL = Protocol()


def driven_mm_s(board: str, told_mm_s: int, inductance_mh: float) -> float:
    """The speed that the left wheel of a body on a board reaches, by its encoder, when both are told this one."""
    boards = TwoBoards(body=board)
    boards.cut = True
    boards.robot.winding = Winding(henry=inductance_mh / 1000)
    kind = body_kind("kit")
    params = kind.reach(SimParams())
    arena = Arena(generate(2, 1, params), params, kind=kind)
    arena.begin(2)
    boards.robot.join(arena.body.kit)
    kit, begin = arena.body.kit, 0
    for tick in range(SETTLING_TICKS + TICKS):
        if tick == SETTLING_TICKS:
            begin = kit.wheels[0].place
        _tell(boards, told_mm_s)
    way = (kit.wheels[0].place - begin + 2**63) % 2**64 - 2**63
    return float(way / 65536 * COUNT_MM / (TICKS * TICK_S))


def _tell(boards: TwoBoards, speed_mm_s: int) -> None:
    """A tick, in which the body gets a drive for the senses that it sent last."""
    boards.pass_time(TICK_S)
    said = [_PROTOCOL.decode(frame) for _, frame in boards.heard[-8:]]
    senses = [it.signals for it in said if it is not None and it.name == "SENSES"][-1]
    stamp = {"tick": senses["tick"] % TICK_SPAN, "counter": senses["counter"] % COUNTERS}
    drive = {
        "left": speed_mm_s,
        "right": speed_mm_s,
        "reason": Reason.WANDER,
        "repeat_count": 0,
        "eat": 0,
        "action": 1,
    }
    boards.body.send(_PROTOCOL.encode("DRIVE", drive | stamp))


def lines(inductances_mh: Sequence[float] = INDUCTANCES_MH) -> Iterator[str]:
    """The table as it stands in docs/build.md: driven speeds, mm/s."""
    told = [way * speed for speed in SPEEDS_MM_S for way in (1, -1)]
    yield f"| inductance | {' | '.join(f'{speed} mm/s' for speed in told)} |"
    yield "|---|" + "---|" * len(told)
    for inductance_mh in inductances_mh:
        driven = " | ".join(f"{driven_mm_s('blue_pill', speed, inductance_mh):.0f}" for speed in told)
        yield f"| {inductance_mh:g} mH | {driven} |"


def test_the_page_has_what_the_table_prints():
    page = (ROOT / "docs/build.md").read_text().splitlines()

    for line in lines(INDUCTANCES_MH[1:2]):
        assert line in page


@pytest.mark.parametrize("board", ["blue_pill", "nucleo_g431rb"])
@pytest.mark.parametrize("way", [1, -1], ids=["forward", "backward"])
@pytest.mark.parametrize("speed_mm_s", [60, 200])
@pytest.mark.parametrize("inductance_mh", INDUCTANCES_MH)
def test_wheels_reach_the_speed_that_they_are_told(inductance_mh, speed_mm_s, way, board):
    driven = driven_mm_s(board, way * speed_mm_s, inductance_mh)

    assert driven == pytest.approx(way * speed_mm_s, rel=0.05)


if __name__ == "__main__":
    sys.stdout.writelines(f"{line}\n" for line in lines())
