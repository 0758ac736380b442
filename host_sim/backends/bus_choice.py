"""`--bus auto`: a private virtual CAN bus where the kernel allows one without root, else a socket pair."""

import os
import sys

from host_sim.paths import ROOT

_WITH_VCAN = ROOT / "tools" / "with-vcan"
_VCAN = "socketcan:vcan0"
_CHOSEN = "OCTET_VCAN_CHOSEN"


def choose_bus(bus: str, robot: str) -> str:
    """Resolves `auto` to a bus.

    With `auto` this may start the whole command again in a network namespace with a bus, and then does not return.

    Args:
        bus: The bus as given on the command line.
        robot: The kind of robot as given; only a spawned robot can be put on a chosen bus.

    Returns:
        The name of the bus, with `auto` replaced by `fd` or `socketcan:vcan0`.
    """
    if bus != "auto":
        return bus
    if robot != "spawn":
        return "fd"
    if os.environ.get(_CHOSEN) == "1":
        return _VCAN
    import subprocess  # noqa: PLC0415 - a run in this process begins sooner without

    how = subprocess.run([_WITH_VCAN, "--how"], capture_output=True, text=True, check=False).stdout.strip()
    if how in ("present", "namespace"):
        command = [os.fspath(_WITH_VCAN), sys.executable, "-m", "host_sim", *sys.argv[1:]]
        os.execve(_WITH_VCAN, command, {**os.environ, _CHOSEN: "1"})
    return "fd"
