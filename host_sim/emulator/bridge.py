"""A motor bridge (DRV8833) and a motor's winding: the voltage that a motor gets from two inputs with PWM.

By its truth table, inputs 1/0 drive forward, 0/1 backward, 1/1 shorts the motor, which brakes it (slow decay), and
0/0 opens all switches: then the current flows back into the supply through diodes until it ends (fast decay).
"""

from math import exp, log1p
from typing import NamedTuple

PWM_S = 1 / 20_000


class Winding(NamedTuple):
    """The winding of a motor.

    Attributes:
        ohm: Its resistance, with that of the switches.
        henry: Its inductance.
    """

    ohm: float = 9.0
    henry: float = 1e-3


def voltage(in_1: float, in_2: float, emf: float, winding: Winding) -> float:
    """Mean voltage at a motor in a period of the PWM, once the current repeats itself, as a fraction of the supply's.

    Args:
        in_1: Fraction of the period, from its beginning, for which the first input is high.
        in_2: Likewise of the second one.
        emf: Voltage that the motor generates by its speed, as a fraction of the supply's, forward positive.
        winding: Its winding.
    """
    drives, coasts = abs(in_1 - in_2), 1.0 - max(in_1, in_2)
    if coasts <= 0:
        return in_1 - in_2  # driven or shorted, it is a linear circuit
    if drives == 0:
        return emf * coasts
    ahead = 1 if in_1 > in_2 else -1
    emf = min(max(ahead * emf, -0.99), 0.99)
    periods = PWM_S * winding.ohm / winding.henry
    most = (1 - emf) * (1 - exp(-drives * periods))
    falls = log1p(most / (1 + emf)) / periods
    if falls >= coasts:
        return ahead * (drives - coasts)  # the current never ends
    return ahead * (drives - falls + (coasts - falls) * emf)
