"""The bit rates of CAN buses."""

BIT_RATES = (125_000, 250_000, 500_000, 1_000_000)
"""The usual ones, bits a second."""

BIT_RATE = 500_000
"""The one that is meant where none is named."""
