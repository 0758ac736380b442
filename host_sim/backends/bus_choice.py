"""`--bus auto`: a virtual CAN bus of our own where the kernel lets anyone have one, else a socket pair."""

import os
import subprocess
import sys

from host_sim.paths import ROOT

_WITH_VCAN = ROOT / "tools" / "with-vcan"
_VCAN = "socketcan:vcan0"
_CHOSEN = "OCTET_VCAN_CHOSEN"


def choose_bus(bus: str, robot: str) -> str:
    """The bus that a name stands for.

    With `auto` this may start the whole command anew where there is a bus, and then does not return.

    Args:
        bus: As given.
        robot: As given; only a robot that we start can be put on a bus that we choose.

    Returns:
        The name, with `auto` made up as `fd` or as `socketcan:vcan0`.
    """
    if bus != "auto":
        return bus
    if robot != "spawn":
        return "fd"
    if os.environ.get(_CHOSEN) == "1":
        return _VCAN
    how = subprocess.run([_WITH_VCAN, "--how"], capture_output=True, text=True, check=False).stdout.strip()
    if how in ("present", "namespace"):
        command = [os.fspath(_WITH_VCAN), sys.executable, "-m", "host_sim", *sys.argv[1:]]
        os.execve(_WITH_VCAN, command, {**os.environ, _CHOSEN: "1"})
    return "fd"
