"""How the robots of a run are reached: which kind of robot, on which bus.

`--bus auto` is a private virtual CAN bus where the kernel allows one without root, else a socket pair.
"""

import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.base.paths import ROOT
from host_sim.base.system import HAS_ROBOT_PROCESSES
from host_sim.client.deadlines import Limits
from host_sim.transport.link import BIT_RATE
from host_sim.transport.rule import Rule

if TYPE_CHECKING:
    from host_sim.sim.in_process_link import Program
    from host_sim.sim.own_brain import OwnBrain

ROBOTS = ("spawn", "external", "qemu", "emulated", "observe")
"""The ways to get a robot."""

BOARDS = ("feather_stm32f405", "blue_pill", "nucleo_g431rb")
"""Boards that our own emulator emulates."""

PICO = "pico"
"""A board that another program emulates."""

_WITH_VCAN = ROOT / "tools" / "with-vcan"
_VCAN = "socketcan:vcan0"
_IMAGE_NODE = 1
_CHOSEN = "OCTET_VCAN_CHOSEN"


@dataclass(frozen=True)
class Access:
    """All that is needed to reach the robots of a run.

    Attributes:
        bus: `none`, `fd`, or python-can's `INTERFACE:CHANNEL`; for emulated robots, which bring their own bus, `none`
            or `fd`.
        robot: One of `ROBOTS`: `spawn` to start the firmware, `external` for a robot that is on the bus already,
            `qemu` or `emulated` to run the flash image.
        nodes: Node numbers of the robots, each 1..31.
        board: One of `BOARDS` or `PICO`, for an emulated robot; empty for the first.
        pins: Whether an emulated robot senses and drives by itself, through its pins.
        command: Program to start as each robot; empty for the firmware.
        bitrate: Bus bit rate, bit/s, for a bus that is set up when opened.
        reconnect_s: Time to wait for a bus that is gone, s of wall-clock time.
        owner: Owner ID of this simulator.
        lockstep: Whether the world waits for the robots; otherwise it keeps to the wall clock.
        limits: Limits beyond which a result in real time is doubtful.
        faults: Faults to inject into the frames of each robot.
        fault_seed: Seed for the faults.
        gdb: Whether the robot is started in gdb.
        own: The user's behaviour of the robots; None for the firmware's.
        program: The program that is each robot's brain; None for none.
        fast: Whether a robot with such a behaviour may run in this process, where its mistakes are not contained.

    Raises:
        UsageError: Such a robot cannot be on that bus, or not with that number.
    """

    bus: str = "none"
    robot: str = ROBOTS[0]
    nodes: Sequence[int] = (1,)
    board: str = ""
    pins: bool = False
    command: str = ""
    bitrate: int = BIT_RATE
    reconnect_s: float = 0.0
    owner: int = 1
    lockstep: bool = True
    limits: Limits = field(default_factory=Limits)
    faults: Sequence[Rule] = ()
    fault_seed: int = 1
    gdb: bool = False
    own: "OwnBrain | None" = None
    program: "Program | None" = None
    fast: bool = False

    def __post_init__(self) -> None:
        check_robot(self.bus, self.robot, self.nodes)


def check_robot(bus: str, robot: str, nodes: Sequence[int]) -> None:
    """Refuses a kind of robot that cannot be on the given bus.

    Args:
        bus: The bus as given on the command line.
        robot: One of `ROBOTS`.
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
        way = subprocess.run([_WITH_VCAN, "--quick-way"], capture_output=True, text=True, check=False).stdout.strip()
    except OSError:  # the script is not here, or cannot run
        return "fd"
    if way:
        command = [os.fspath(_WITH_VCAN), sys.executable, "-m", "host_sim", *sys.argv[1:]]
        os.execve(_WITH_VCAN, command, {**os.environ, _CHOSEN: "1"})
    return "fd"
