"""What can be wrong with a body: what its robot is told, and what its wheels do."""

import pytest

from host_sim.protocol.generated import FEEL, NOTHING_SENSED, Ranges
from host_sim.world.arena import Arena
from host_sim.world.body_faults import FAULT_NAMES, SOUND, BodyFaults, noise_key, with_fault
from host_sim.world.layouts import generate
from host_sim.world.params import SimParams

SENSES = NOTHING_SENSED._replace(feel=FEEL["RIGHT"] | FEEL["FRONT_LEFT"], odometer_left=3, odometer_right=5)
RANGES = Ranges(10, 20, 30, 40, None)


def after(*faults: str) -> BodyFaults:
    broken = SOUND
    for fault in faults:
        broken = with_fault(broken, fault)
    return broken


def feel(*faults: str, of: int = SENSES.feel) -> int:
    return after(*faults).sensed(SENSES._replace(feel=of), 0).feel


def test_a_sound_body_is_told_as_it_is():
    assert SOUND.sensed(SENSES, 7) == SENSES
    assert SOUND.measured(RANGES) == RANGES
    assert SOUND.driven(-200, 150) == (-200, 150)


def test_a_mirrored_ring_has_right_for_left():
    assert feel("mirror") == FEEL["LEFT"] | FEEL["FRONT_RIGHT"]
    assert after("mirror").measured(RANGES) == Ranges(None, 40, 30, 20, 10)


def test_swapped_motors_are_swapped_with_their_odometers():
    swapped = after("swap-motors")

    assert swapped.driven(200, -150) == (-150, 200)
    assert swapped.sensed(SENSES, 0) == SENSES._replace(odometer_left=5, odometer_right=3)


def test_swapping_or_mirroring_twice_undoes_it():
    assert after("mirror", "swap-motors", "swap-motors", "mirror") == SOUND


@pytest.mark.parametrize("name", ["right", "front-right", "front", "front-left", "left"])
def test_a_stuck_sensor_sees_always_or_never(name):
    bit = FEEL[name.upper().replace("-", "_")]

    assert feel(f"stuck-on:{name}", of=0) == bit
    assert feel(f"stuck-off:{name}", of=31) == 31 & ~bit


def test_a_stuck_sensor_measures_nothing_but_that():
    assert after("stuck-on:front", "stuck-off:right").measured(RANGES) == Ranges(None, 20, 0, 40, None)


def test_the_last_way_in_which_a_sensor_is_stuck_holds():
    assert feel("stuck-on:front", "stuck-off:front", of=31) == 31 & ~FEEL["FRONT"]
    assert feel("stuck-off:front", "stuck-on:front", of=0) == FEEL["FRONT"]


def test_it_is_the_robots_own_sensor_that_is_stuck_also_in_a_mirrored_ring():
    assert feel("stuck-on:left", "mirror", of=0) == FEEL["LEFT"]


def test_a_weak_motor_turns_at_its_share_of_the_speed_toward_0():
    weak = after("weak-motor:left:60%", "weak-motor:right:33%")

    assert weak.driven(200, 200) == (120, 66)
    assert weak.driven(-201, -200) == (-120, -66)
    assert after("weak-motor:left:60%", "weak-motor:left:100%") == SOUND


def test_it_is_the_motor_that_is_weak_wherever_its_plug_is():
    assert after("swap-motors", "weak-motor:left:50%").driven(100, 40) == (20, 100)


def test_an_odometer_counts_its_share_of_the_way():
    assert SOUND.counted(3.3, -5.1) == (3.3, -5.1)
    assert after("odometer:left:0%").counted(3.0, 5.0) == (0.0, 5.0)
    assert after("odometer:left:-100%", "odometer:right:150%").counted(3.0, 5.0) == (-3.0, 7.5)
    assert after("odometer:left:50%", "odometer:left:100%") == SOUND


def test_swapped_odometers_count_each_others_wheels():
    assert after("swap-odometers").counted(3.0, 5.0) == (5.0, 3.0)
    assert after("swap-odometers", "odometer:left:0%").counted(3.0, 5.0) == (0.0, 3.0)


def test_an_odometer_that_becomes_stuck_stands_still_where_it_is():
    arena = Arena(generate(1, 1, SimParams()), SimParams())
    arena.body.move(200, 200)
    arena.body.faults = after("odometer:left:0%")
    arena.body.move(200, 200)

    senses = arena.body.sense(0)

    assert (senses.odometer_left, senses.odometer_right) == (40, 80)


def test_a_false_beacon_shows_food_only_where_none_is_seen():
    false = after("false-beacon:100")
    real = SENSES._replace(look=True, beacon_mm=700)

    assert false.sensed(SENSES, 0) == SENSES._replace(look=True, beacon_mm=100)
    assert false.sensed(real, 0) == real
    assert after("false-beacon:100", "false-beacon:0") == SOUND


def wrong_bits(faults: BodyFaults, ticks: range) -> list[int]:
    return [faults.sensed(NOTHING_SENSED, tick).feel for tick in ticks]


def test_noise_makes_each_sensor_wrong_as_often_as_it_says():
    bits = wrong_bits(with_fault(SOUND, "noise:10/1000", noise_key(1, 0)), range(40_000))

    for bit in FEEL.values():
        assert sum(wrong & bit > 0 for wrong in bits) == pytest.approx(400, abs=80)


def test_noise_of_a_tick_is_the_same_whenever_it_is_asked_for():
    noisy = with_fault(SOUND, "noise:1/3", noise_key(1, 0))

    assert wrong_bits(noisy, range(50))[40:] == wrong_bits(noisy, range(40, 50))


def test_another_seed_or_robot_has_other_noise():
    keys = [noise_key(1, 0), noise_key(2, 0), noise_key(1, 1)]
    patterns = {tuple(wrong_bits(with_fault(SOUND, "noise:1/3", key), range(50))) for key in keys}

    assert len(patterns) == 3


def test_noise_follows_from_known_numbers():
    noisy = BodyFaults(noise=300, noise_of=1000, noise_key=7)

    assert wrong_bits(noisy, range(6)) == [3, 18, 19, 22, 16, 16]


def test_all_ticks_can_be_wrong_and_none():
    assert feel("noise:1/1", of=0) == 31
    assert feel("noise:0/5", of=0) == 0


def test_a_repair_mends_everything():
    assert after("mirror", "noise:1/2", "stuck-on:front", "weak-motor:left:5%", "repair") is SOUND


@pytest.mark.parametrize(
    ("what", "meant"),
    [
        ("mirrored", "did you mean 'mirror'?"),
        ("explode", f"choose from {', '.join(FAULT_NAMES)}"),
        ("mirror:left", "write mirror"),
        ("stuck-on", "write stuck-on:SENSOR, with SENSOR one of right, front-right"),
        ("stuck-off:nose", "write stuck-off:SENSOR"),
        ("noise:5", "write noise:N/TICKS, such as noise:10/1000"),
        ("noise:11/10", "11 of 10 ticks cannot be"),
        ("noise:0/0", "0 of 0 ticks cannot be"),
        ("noise:1/9999999", "1 of 9999999 ticks cannot be; at most all of 1000000"),
        ("weak-motor:left", "write weak-motor:left:60% or"),
        ("weak-motor:left:101%", "a motor has at most 100%"),
        ("odometer:left", "write odometer:left:0% or"),
        ("odometer:left:1000%", "write odometer:left:0% or"),
        ("false-beacon", "write false-beacon:MM"),
        ("false-beacon:8192", "food is seen up to 8191 mm away"),
    ],
)
def test_what_cannot_happen_is_refused_with_what_was_meant(what, meant):
    with pytest.raises(ValueError) as raised:  # noqa: PT011 - the text is compared below
        with_fault(SOUND, what)

    assert str(raised.value).startswith(meant)
