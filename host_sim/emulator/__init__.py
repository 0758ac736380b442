"""A small emulated microcontroller board: the very image that is flashed, on models of the hardware that it touches.

The core is Unicorn's (GPL-2: for tests and emulation only, imported in `core.py` alone). Time is made of executed
instructions, so that a run is the same on any machine, however loaded.
"""
