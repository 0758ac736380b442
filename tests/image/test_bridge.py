"""The bridge's mean voltages, compared with its truth table and with the motor's current computed step by step."""

import pytest

from host_sim.emulator.bridge import PWM_S, Winding, voltage

STEPS, PERIODS = 2000, 30


def stepped(in_1: float, in_2: float, emf: float, winding: Winding) -> float:
    """The mean voltage of the last of many periods, from the differential equation of the winding."""
    current, total = 0.0, 0.0
    for _ in range(PERIODS):
        total = 0.0
        for step in range(STEPS):
            high = [step < duty * STEPS for duty in (in_1, in_2)]
            if any(high):
                applied = float(high[0] - high[1])
            elif current != 0:
                applied = -1.0 if current > 0 else 1.0
            else:
                applied = emf
            after = current + (applied - emf - current * winding.ohm) * PWM_S / STEPS / winding.henry
            current = 0.0 if not any(high) and after * current <= 0 else after
            total += applied
    return total / STEPS


@pytest.mark.parametrize("henry", [0.3e-3, 1e-3, 2e-3])
@pytest.mark.parametrize("emf", [0.0, 0.3, -0.1])
@pytest.mark.parametrize("inputs", [(0.4, 0.0), (0.8, 0.0), (0.0, 0.3), (1.0, 0.6), (0.6, 1.0), (1.0, 1.0)])
def test_a_motor_s_mean_voltage_is_that_of_its_current_step_by_step(inputs, emf, henry):
    winding = Winding(henry=henry)

    assert voltage(*inputs, emf, winding) == pytest.approx(stepped(*inputs, emf, winding), abs=0.01)


@pytest.mark.parametrize(("inputs", "wanted"), [((1, 0), 1), ((0, 1), -1), ((1, 1), 0), ((0, 0), 0.3)])
def test_steady_inputs_follow_the_truth_table(inputs, wanted):
    assert voltage(*inputs, 0.3, Winding()) == pytest.approx(wanted)
