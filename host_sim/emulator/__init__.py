"""A small emulated microcontroller board: the very image that is flashed, on models of the hardware that it touches.

The core is Unicorn's (GPL-2: for tests and emulation only, imported in `core.py` alone). Time is made of executed
instructions, so that a run is the same on any machine, however loaded.
"""

from importlib.util import find_spec

from host_sim.errors import OctetError

for _package in ("unicorn", "elftools"):
    if find_spec(_package) is None:
        raise OctetError(f"{_package} is not installed: run tools/setup emulator")
