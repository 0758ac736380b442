"""A robot that runs on an emulated board: it drives, waits, blinks, and starts from the clocks that there are."""

import time
from itertools import pairwise

import pytest

from host_sim.emulator.clock import SECOND
from host_sim.emulator.hardware import Faults
from host_sim.emulator.rcc import RccFaults
from tests.image.support import counted, is_rest, talk_to
from tools.verify.tick_cost import count_ticks


def changes(levels: list[bool]) -> int:
    return sum(before != after for before, after in pairwise(levels))


def test_started_robot_drives_and_counts_no_fault(talk):
    talk.start()

    drives = talk.live(100)

    assert [drive.signals["tick"] for drive in drives] == list(range(100))
    assert not any(map(is_rest, drives[5:50]))
    assert counted(talk.ask()) == {}
    assert talk.board.resets == []


def test_registers_behave_alike_in_c_and_python(name):
    talks = [talk_to(name), talk_to(name)]
    talks[1].board.hardware.space.watch()

    for talk in talks:
        talk.start()
        talk.live(20)

    direct, watched = talks
    assert direct.heard == watched.heard
    assert direct.board.hardware.core.instructions == watched.board.hardware.core.instructions
    assert direct.board.hardware.clock.now == watched.board.hardware.clock.now


def test_wheels_stop_after_100_ms_without_senses(driving):
    before = driving.wait(0.07)
    after = driving.wait(0.05)

    assert before == []
    assert [is_rest(said) for said in after if said.name == "DRIVE"] == [True]
    assert counted(driving.ask()) == {"silences": 1}


def test_led_blinks_slowly_and_fast_without_senses(talk):
    talk.start()
    port, pin = talk.board.hardware.wiring.port("LED")

    well = [port.level(pin) for _ in range(150) if talk.live(1)]
    talk.wait(0.2)
    failing = [port.level(pin) for _ in range(150) if talk.wait(0.02) is not None]

    assert len(well) == len(failing) == 150
    assert 4 <= changes(well) <= 8
    assert 18 <= changes(failing) <= 28


def test_robot_drives_on_when_senses_return(driving):
    driving.wait(1.0)

    assert len(driving.live(10)) == 10


def test_lockstep_robot_waits_longer_than_the_watchdog_period(name):
    talk = talk_to(name, lockstep=1)
    talk.start()
    talk.live(10)

    talk.wait(8.0)

    assert len(talk.live(10)) == 10
    assert talk.board.resets == []
    assert counted(talk.ask()) == {}


INTERNAL_MHZ = {"feather_stm32f405": (168, 16), "blue_pill": (64, 8), "nucleo_g431rb": (80, 16)}
"""What the internal oscillator makes of the core's clock, with the PLL and without."""


@pytest.mark.parametrize("crystal_s", [0.001, 0.099])
def test_core_runs_at_full_speed_from_its_crystal(name, crystal_s):
    talk = talk_to(name, Faults(rcc=RccFaults(crystal_s=crystal_s)))
    hardware = talk.board.hardware

    assert hardware.rcc.core_hz() == hardware.chip.oscillators.core_max
    assert hardware.rcc.follows_crystal()
    assert talk.ask()["clock"] == 1


@pytest.mark.parametrize(
    "dead",
    [RccFaults(crystal_dead=True), RccFaults(pll_dead=True), RccFaults(crystal_s=0.2)],
    ids=["crystal", "pll", "slow"],
)
def test_robot_works_without_crystal_and_reports_it(name, dead):
    talk = talk_to(name, Faults(rcc=dead))
    talk.start()
    with_pll, without = INTERNAL_MHZ[name]

    assert talk.board.hardware.rcc.core_hz() == (without if dead.pll_dead else with_pll) * 1_000_000
    assert len(talk.live(50)) == 50
    report = talk.ask()
    assert counted(report) == {}
    assert report["clock"] == 0


def test_watchdog_period_is_1500_to_2100_ms(talk):
    assert 1.5 <= talk.board.hardware.watchdog.period_s() <= 2.1


def test_watchdog_resets_a_halted_core_and_the_robot_rests(driving):
    driving.board.hardware.clock.skip(4 * SECOND)
    driving.wait(0.1)

    assert driving.board.resets == ["watchdog"]
    assert all(map(is_rest, driving.live(10)))
    driving.start()
    assert not all(map(is_rest, driving.live(10)))


def test_same_run_takes_the_same_instructions():
    first, second = (count_ticks("feather_stm32f405", 7, 300) for _ in range(2))

    assert first == second


def test_receive_from_a_silent_board_waits_for_its_timeout(talk):
    while not talk.wait(0.001):
        pass  # until it has told that all is silent, which is news every 0.1 s
    began = time.monotonic()

    assert talk.board.receive(0.05) is None
    assert time.monotonic() - began >= 0.05
