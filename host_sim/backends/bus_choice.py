"""Which robot can be on which bus.

`--bus auto` is a private virtual CAN bus where the kernel allows one without root, else a socket pair.
"""

import os
import sys
from collections.abc import Sequence

from host_sim.base.errors import UsageError
from host_sim.base.paths import ROOT
from host_sim.base.system import HAS_ROBOT_PROCESSES

_WITH_VCAN = ROOT / "tools" / "with-vcan"
_VCAN = "socketcan:vcan0"
_IMAGE_NODE = 1
_CHOSEN = "OCTET_VCAN_CHOSEN"


def check_robot(bus: str, robot: str, nodes: Sequence[int]) -> None:
    """Refuses a kind of robot that cannot be on the given bus.

    Args:
        bus: The bus as given on the command line.
        robot: One of `host_sim.sim.run_config.ROBOTS`.
        nodes: The robots' node numbers.

    Raises:
        UsageError: The robot cannot be on that bus, or not with that number.
    """
    interface = bus.partition(":")[0]
    if robot in ("qemu", "emulated"):
        _check_emulated(bus, robot, nodes)
    elif robot in ("external", "observe") and interface in ("auto", "none", "fd"):
        raise UsageError(f"--robot {robot} needs the bus of the robot, --bus INTERFACE:CHANNEL, not --bus {bus}")
    elif robot == "spawn" and interface not in ("auto", "none") and not HAS_ROBOT_PROCESSES:
        raise UsageError(f"on this system a robot can only run in this process, not on {bus}: use --bus none")
    elif robot == "spawn" and ":" in bus and interface != "socketcan":
        raise UsageError(f"a robot cannot be started on {bus}, only on socketcan or fd: use --robot external")


def _check_emulated(bus: str, robot: str, nodes: Sequence[int]) -> None:
    if bus not in ("auto", "none", "fd"):
        raise UsageError(
            f"--robot {robot} brings its own bus: leave out --bus {bus}; or start a board on that bus with"
            f" python -m host_sim.emulator --bus {bus}, and use --robot external"
        )
    if list(nodes) != [_IMAGE_NODE]:
        raise UsageError(f"the flash image is node {_IMAGE_NODE}, not {nodes[-1]}: leave out --node and --robots")


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
    if not HAS_ROBOT_PROCESSES:
        return "none"
    if os.environ.get(_CHOSEN) == "1":
        return _VCAN
    import subprocess  # noqa: PLC0415 - a run in this process begins sooner without

    try:
        how = subprocess.run([_WITH_VCAN, "--how"], capture_output=True, text=True, check=False).stdout.strip()
    except OSError:  # the script is not here, or cannot run
        return "fd"
    if how in ("present", "namespace"):
        command = [os.fspath(_WITH_VCAN), sys.executable, "-m", "host_sim", *sys.argv[1:]]
        os.execve(_WITH_VCAN, command, {**os.environ, _CHOSEN: "1"})
    return "fd"
