"""The images that are flashed, on emulated boards: they work, and bear what can go wrong."""

import time
from itertools import pairwise

import pytest

from host_sim.bench.tick_cost import count_ticks
from host_sim.emulator.board import Faults
from host_sim.emulator.can import CanFaults, CanFrame
from host_sim.emulator.clock import SECOND
from host_sim.emulator.flash import FlashFaults
from host_sim.emulator.rcc import RccFaults
from host_sim.protocol.generated import Side
from tests.image.support import BOARDS, Talk, counted, is_rest, talk_to

NOISE_PER_TICK = 200
"""Ten thousand frames a second."""


LED_PINS = {"feather_stm32f405": 1, "blue_pill": 13}
"""Of port C."""


def changes(levels: list[bool]) -> int:
    return sum(before != after for before, after in pairwise(levels))


@pytest.fixture(params=BOARDS)
def name(request):
    return request.param


def test_a_started_robot_drives_and_counts_no_fault(name):
    talk = talk_to(name)
    talk.start()

    drives = talk.live(100)

    assert [drive.signals["tick"] for drive in drives] == list(range(100))
    assert not any(map(is_rest, drives[5:50]))
    assert counted(talk.ask()) == {}
    assert talk.board.resets == []


def test_registers_do_the_same_in_c_as_in_python(name):
    talks = [talk_to(name), talk_to(name)]
    talks[1].board.hardware.space.watch()

    for talk in talks:
        talk.start()
        talk.live(20)

    direct, watched = talks
    assert direct.heard == watched.heard
    assert direct.board.hardware.core.instructions == watched.board.hardware.core.instructions
    assert direct.board.hardware.clock.now == watched.board.hardware.clock.now


def test_wheels_stop_after_100_ms_without_senses(name):
    talk = talk_to(name)
    talk.start()
    talk.live(10)

    before = talk.wait(0.07)
    after = talk.wait(0.05)

    assert before == []
    assert [is_rest(said) for said in after if said.name == "DRIVE"] == [True]
    assert counted(talk.ask()) == {"silences": 1}


def test_the_led_blinks_slowly_while_all_is_well_and_fast_while_senses_fail(name):
    talk = talk_to(name)
    talk.start()
    port, pin = talk.board.hardware.pins[2], LED_PINS[name]

    well = [port.level(pin) for _ in range(150) if talk.live(1)]
    talk.wait(0.2)
    failing = [port.level(pin) for _ in range(150) if talk.wait(0.02) is not None]

    assert len(well) == len(failing) == 150
    assert 4 <= changes(well) <= 8
    assert 18 <= changes(failing) <= 28


def test_it_drives_on_when_senses_come_again(name):
    talk = talk_to(name)
    talk.start()
    talk.live(10)
    talk.wait(1.0)

    assert len(talk.live(10)) == 10


def test_in_lockstep_it_waits_longer_than_its_watchdog_would(name):
    talk = talk_to(name, lockstep=1)
    talk.start()
    talk.live(10)

    talk.wait(8.0)

    assert len(talk.live(10)) == 10
    assert talk.board.resets == []
    assert counted(talk.ask()) == {}


INTERNAL_MHZ = {"feather_stm32f405": (168, 16), "blue_pill": (64, 8)}
"""What the internal oscillator makes of the core's clock, with the PLL and without."""


@pytest.mark.parametrize("crystal_s", [0.001, 0.099])
def test_it_runs_at_full_speed_from_its_crystal(name, crystal_s):
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
def test_it_works_without_and_says_so(name, dead):
    talk = talk_to(name, Faults(rcc=dead))
    talk.start()
    with_pll, without = INTERNAL_MHZ[name]

    assert talk.board.hardware.rcc.core_hz() == (without if dead.pll_dead else with_pll) * 1_000_000
    assert len(talk.live(50)) == 50
    report = talk.ask()
    assert counted(report) == {}
    assert report["clock"] == 0


def test_its_watchdog_waits_for_2_s_or_a_little_less(name):
    assert 1.5 <= talk_to(name).board.hardware.watchdog.period_s() <= 2.1


def test_a_controller_that_never_gets_ready_is_tried_again_and_nothing_moves(name):
    talk = talk_to(name, Faults(can=CanFaults(init_stuck=True)))

    said = talk.wait(0.1)

    assert said == []
    assert len(talk.board.resets) > 5
    assert set(talk.board.resets) == {"software"}


def test_it_does_with_two_mailboxes(name):
    talk = talk_to(name, Faults(can=CanFaults(stuck_mailboxes=0b001)))
    talk.start()

    drives = talk.live(100)

    # The first frame that got stuck is lost, and the driver cannot know.
    assert len(drives) >= 99


def test_stuck_mailboxes_cost_frames_and_no_more(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)
    model = talk.board.hardware.can.model

    model.stuck_mailboxes = 0b111
    during = talk.live(20)
    model.stuck_mailboxes = 0
    talk.live(5)

    assert during == []
    assert len(talk.live(20)) == 20
    assert counted(talk.ask())["dropped"] > 0
    assert talk.board.resets == []


def test_frames_lost_in_the_controller_are_counted(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)

    for _ in range(6):
        talk.board.send(talk.senses())
    talk.board.hardware.clock.skip(5 * SECOND // 1000)  # the core stands still meanwhile
    talk.wait(0.02)

    assert talk.board.hardware.can.model.fifos[0].overruns == 3
    report = counted(talk.ask())
    assert report.pop("missed") == 3
    assert report
    assert len(talk.live(10)) == 10


def test_after_bus_off_it_joins_again(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)

    talk.board.hardware.can.wire.shorted = True
    during = talk.live(20)
    talk.board.hardware.can.wire.shorted = False
    first = talk.wait(0.5)

    assert during == []
    assert all(is_rest(said) for said in first if said.name == "DRIVE")
    assert len(talk.live(20)) == 20
    report = talk.ask()
    assert report["bus_offs"] > 0
    assert report["silences"] > 0
    assert talk.board.resets == []


def test_what_waited_during_bus_off_is_not_sent_afterwards(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)
    talk.board.hardware.can.wire.shorted = True
    talk.live(20)
    talk.board.hardware.can.wire.shorted = False
    talk.wait(0.5)

    fresh = talk.live(1)

    assert [drive.signals["tick"] for drive in fresh] == [talk.tick]


def test_a_lone_robot_is_passive_and_drives_on_when_the_other_comes_back(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)

    talk.board.hardware.can.wire.alone = True
    talk.wait(1.0)
    errors = talk.board.hardware.can.model.tec
    talk.board.hardware.can.wire.alone = False
    talk.wait(0.05)

    assert errors == 128  # passive
    assert len(talk.live(10)) == 10
    assert talk.board.resets == []


def test_a_core_that_stands_still_is_reset_by_the_watchdog_and_rests(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)

    talk.board.hardware.clock.skip(4 * SECOND)
    talk.wait(0.1)

    assert talk.board.resets == ["watchdog"]
    assert all(map(is_rest, talk.live(10)))
    talk.start()
    assert not all(map(is_rest, talk.live(10)))


def test_a_crash_is_told_afterwards(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)

    talk.board.hardware.core.derail(0x60000000)
    talk.wait(0.1)
    for _ in range(20):
        talk.ask()

    assert talk.board.resets == ["software"]
    causes = talk.protocol.choices("BOOT", "reset_cause")
    assert talk.last("BOOT")["reset_cause"] == causes["crash"]
    names = {number: register for register, number in talk.protocol.choices("CRASH", "name").items()}
    told = {names[said.signals["name"]]: said.signals["value"] for said in talk.heard if said.name == "CRASH"}
    assert told["pc"] == 0x60000000


@pytest.mark.parametrize("depth", [0, 8, 300, 600, 900])
def test_a_crash_is_told_wherever_the_stack_is(name, depth):
    talk = talk_to(name)
    stack_top = int.from_bytes(talk.board.hardware.flash.memory[:4], "little")

    talk.board.hardware.core.derail(0x60000000, stack=stack_top - depth)
    talk.wait(0.1)
    for _ in range(20):
        talk.ask()

    names = {number: register for register, number in talk.protocol.choices("CRASH", "name").items()}
    told = {names[said.signals["name"]]: said.signals["value"] for said in talk.heard if said.name == "CRASH"}
    assert told["pc"] == 0x60000000


def test_a_stack_that_has_left_the_ram_ends_in_a_crash_too(name):
    talk = talk_to(name)

    talk.board.hardware.core.derail(0x60000000, stack=0x20000008)
    talk.wait(0.1)

    assert talk.board.resets == ["software"]
    assert talk.ask()["reset_cause"] == talk.protocol.choices("BOOT", "reset_cause")["crash"]


def learn(talk: Talk, side: int) -> None:
    """Writes cell 1, and empties the others of its half."""
    talk.order("write", mask=0b1111, half=0, byte_0=0, byte_1=side, byte_2=0, byte_3=0)


def memory_after_power_up(talk: Talk) -> tuple[int, ...]:
    talk.board.cut_power()
    talk.wait(0.1)
    talk.order("stop")
    talk.wait(0.02)
    return talk.memory


def test_the_memory_survives_a_loss_of_power(name):
    talk = talk_to(name)
    learn(talk, Side.LEFT)
    talk.wait(1.0)

    assert memory_after_power_up(talk) == (0, 1, 0, 0, 0, 0, 0, 0)


def test_a_flash_that_is_full_is_erased_and_written_again():
    talk = talk_to("blue_pill")  # its pages are the smaller ones
    for i in range(300):
        learn(talk, (Side.LEFT, Side.RIGHT)[i % 2])
    flash = talk.board.hardware.flash

    assert flash.erasures > 0
    assert counted(talk.ask()) == {}
    assert memory_after_power_up(talk) == (0, 2, 0, 0, 0, 0, 0, 0)


def test_a_memory_that_cannot_be_stored_is_counted_and_the_robot_goes_on(name):
    talk = talk_to(name, Faults(flash=FlashFaults(failing=frozenset(range(1, 1000)))))
    talk.start()
    learn(talk, Side.LEFT)

    assert len(talk.live(50)) == 50
    talk.wait(1.5)  # at rest there is time to erase, in vain
    assert talk.ask()["unsaved"] > 0
    assert talk.board.resets == []


def test_a_loss_of_power_while_storing_leaves_the_old_memory_or_the_new(name):
    found, cut_at, operations = set(), 0, 1
    while cut_at < operations:
        cut_at += 1
        talk = talk_to(name, Faults(flash=FlashFaults(cut_at=cut_at)))
        learn(talk, Side.LEFT)
        talk.wait(0.2)
        learn(talk, Side.RIGHT)
        talk.wait(0.2)
        found.add(memory_after_power_up(talk))
        operations = talk.board.hardware.flash.operations

    assert found == {(0, 1, 0, 0, 0, 0, 0, 0), (0, 2, 0, 0, 0, 0, 0, 0)}


def test_strange_frames_are_counted_or_kept_out(name):
    talk = talk_to(name)
    talk.start()
    talk.live(5)
    senses = talk.protocol.id_of("SENSES")
    command = talk.protocol.id_of("COMMAND")

    for frame in (
        CanFrame(senses, b"short"),
        CanFrame(senses),
        CanFrame(command, b"wrong CRC"[:8]),
    ):
        talk.board.put(frame)
    for frame in (
        CanFrame(senses, bytes(8), remote=True),
        CanFrame(senses << 18, bytes(8), extended=True),
        CanFrame(senses, bytes(8), extended=True),
        CanFrame(senses + 1, bytes(8)),
        CanFrame(0x7FF),
        CanFrame(0),
    ):
        talk.board.put(frame)
    talk.wait(0.01)

    assert len(talk.live(10)) == 10
    assert counted(talk.ask()) == {"damaged": 3}


def test_ten_thousand_frames_of_noise_a_second_do_not_cost_a_tick(name):
    talk = talk_to(name)
    talk.start()
    before = len(talk.heard)

    for _ in range(25):
        talk.board.send(talk.senses())
        for i in range(NOISE_PER_TICK):
            talk.board.put(CanFrame(0x200 + i))
        talk.wait(0.02)

    drives = [said for said in talk.heard[before:] if said.name == "DRIVE"]
    assert [drive.signals["tick"] for drive in drives] == list(range(25))
    assert counted(talk.ask()) == {}


def test_noise_on_its_own_identifiers_is_counted_and_does_not_cost_a_tick(name):
    talk = talk_to(name)
    talk.start()
    before = len(talk.heard)
    noise = CanFrame(talk.protocol.id_of("SENSES"))

    for _ in range(10):
        talk.board.send(talk.senses())
        for _ in range(NOISE_PER_TICK):
            talk.board.put(noise)
        talk.wait(0.02)

    drives = [said for said in talk.heard[before:] if said.name == "DRIVE"]
    assert [drive.signals["tick"] for drive in drives] == list(range(10))
    assert talk.ask()["damaged"] == 255


def test_the_same_run_takes_the_same_instructions():
    first, second = (count_ticks("feather_stm32f405", 7, 300) for _ in range(2))

    assert first == second


def test_a_board_that_has_nothing_to_say_takes_its_time(name):
    talk = talk_to(name)
    while not talk.wait(0.001):
        pass  # until it has told that all is silent, which is news every 0.1 s
    began = time.monotonic()

    assert talk.board.receive(0.05) is None
    assert time.monotonic() - began >= 0.05
