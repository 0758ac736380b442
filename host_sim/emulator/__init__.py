"""A small emulated microcontroller board: runs the flash image on models of the hardware that it uses.

The core is Unicorn's (GPL-2: for tests and emulation only, imported in `core.py` alone). Time is counted in
executed instructions, so that a run is the same on any machine under any load.
"""
