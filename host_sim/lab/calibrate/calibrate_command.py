"""`tools/octet calibrate`: calibrates a robot with a body on pins, or shows its calibration."""

import argparse
import sys
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError, meant
from host_sim.cli.parsing import Subparsers, add_command, number
from host_sim.cli.run_options import add_option

if TYPE_CHECKING:
    from host_sim.lab.calibrate.calibration import Calibration, Places

STEPS = {
    "light": "a white wall 60 mm before each of its five sensors: a half ring of cardboard",
    "motors": "its wheels in the air",
    "track": "beside one wall, 30 to 50 mm away, and nothing else within half a metre: it turns about five times",
}
_EXAMPLES = """\
examples:
  tools/octet calibrate --bus socketcan:can0             all three, with instructions before each
  tools/octet calibrate track --bus socketcan:can0       only that
  tools/octet calibrate --show --bus socketcan:can0      show the stored values; nothing moves
  tools/octet calibrate --set body_track_mm=163 --bus socketcan:can0
  tools/octet calibrate --robot emulated --seed 3        an emulated Blue Pill in a kit body, beside the true values

An impossible result is refused, and the old values stay. Without a PC, use the button: see docs/build.md.
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "calibrate",
        _calibrate,
        summary="calibrate the sensors, motors and track of a stand-alone robot",
        description="Calibrates a robot's sensors, motors and track, and stores the results in its flash.",
        epilog=_EXAMPLES,
        check=_check,
        stages=lambda arguments: ["emulator", "blue_pill"] if arguments.robot == "emulated" else ["run"],
    )
    add_ = parser.add_argument
    add_("steps", nargs="*", metavar="STEP", help=f"{', '.join(STEPS)} (default: all)")
    add_("--bus", metavar="BUS", help="any bus of python-can: INTERFACE:CHANNEL, such as socketcan:can0")
    add_("--robot", choices=("external", "emulated"), default="external", help="where it is (default: %(default)s)")
    add_("--node", type=number(1, 31), default=1, help="the robot's node number, 1..31 (default: 1)")
    add_option(parser, "bitrate")
    add_("--show", action="store_true", help="only show the stored values")
    add_("--set", action="append", default=[], metavar="NAME=VALUE", help="store a value instead of measuring it")
    add_("--body", default="kit", metavar="BODY", help="emulated: its body, kit or a file (default: kit)")
    add_("--seed", type=number(0, 2**32 - 1), default=1, help="emulated: seed of its body (default: 1)")
    add_("--yes", action="store_true", help="do not ask before each step: the robot is in place already")


def _check(arguments: argparse.Namespace) -> None:
    for step in arguments.steps:
        if step not in STEPS:
            raise UsageError(f"there is no {step!r} to calibrate: {meant(step, STEPS)}")
    if arguments.bus is None and arguments.robot == "external":
        raise UsageError("calibrate needs a robot: give --bus INTERFACE:CHANNEL, or --robot emulated")
    if arguments.bus is not None and arguments.robot == "emulated":
        raise UsageError("an emulated robot is on no bus: leave --bus out, or --robot emulated")
    if arguments.steps and (arguments.show or arguments.set):
        raise UsageError("give steps to measure, or --show or --set")
    arguments.settings = dict(map(_setting, arguments.set))


def _setting(text: str) -> tuple[str, int]:
    from host_sim.lab.calibrate.calibration import CALIBRATION_VALUES

    name, _, value = text.partition("=")
    if name not in CALIBRATION_VALUES:
        raise UsageError(f"there is no {name!r} to set: {meant(name, CALIBRATION_VALUES)}")
    row = CALIBRATION_VALUES[name]
    if not value.isdecimal() or not row.minimum <= int(value) <= row.maximum:
        raise UsageError(
            f"{name} must be a whole number from {row.minimum} to {row.maximum} {row.unit}, not {value!r}"
        )
    return name, int(value)


def _calibrate(arguments: argparse.Namespace) -> int:
    with ExitStack() as stack:
        calibration, places = _reached(stack, arguments)
        before = calibration.stored_values()
        for name, value in arguments.settings.items():
            calibration.set(name, value)
        steps: Sequence[str] = () if arguments.show or arguments.set else arguments.steps or list(STEPS)
        refused = [step for step in steps if not _measures(calibration, places, step, ask=not arguments.yes)]
        _print(before, calibration.stored_values(), places.true_values() if places else {})
    return int(bool(refused))


def _reached(stack: ExitStack, arguments: argparse.Namespace) -> "tuple[Calibration, Places | None]":
    import time

    from host_sim.client.frame_log import NoLog
    from host_sim.lab.calibrate.calibration import Calibration
    from host_sim.sim.connect import Connector
    from host_sim.sim.run_config import RunConfig

    emulated = arguments.robot == "emulated"
    where = {"board": "blue_pill", "body": "pins"} if emulated else {"bus": arguments.bus}
    config = RunConfig(
        robot=arguments.robot, node=1 if emulated else arguments.node, bitrate=arguments.bitrate, **where
    )
    log = NoLog()
    stack.callback(log.close)
    client = Connector(stack, config.access).client(config.node, log, senses_itself=True)
    if not emulated:
        return Calibration(client, time.sleep), None
    from host_sim.emulator.pins_board import PinsBoard
    from host_sim.lab.calibrate.calibration import Places

    board = client.connection.link
    assert isinstance(board, PinsBoard)  # by the configuration
    places = Places(board, arguments.body, arguments.seed)
    return Calibration(client, places.wait), places


def _measures(calibration: "Calibration", places: "Places | None", step: str, *, ask: bool) -> bool:
    """Runs one measurement and prints its result. Returns whether it was stored."""
    if places:
        places.put(step)
    elif ask and sys.stdin.isatty():
        try:
            input(f"{step}: {STEPS[step]}. Press Enter when it is in place: ")
        except EOFError:
            raise UsageError(f"{step} and what follows it were not measured: the input has ended") from None
    why = calibration.measure(step)
    print(f"{step}: refused, and the old values stay: {why}" if why else f"{step}: measured and stored")
    return not why


def _print(before: Mapping[str, int], after: Mapping[str, int], true: Mapping[str, float]) -> None:
    from host_sim.lab.calibrate.calibration import CALIBRATION_VALUES
    from host_sim.lab.table import aligned

    head = ("", "before", "now", *["true"] * bool(true), "unit")
    rows = []
    for name, row in CALIBRATION_VALUES.items():
        shown = [f"{true[name]:.1f}"] if true else []
        rows.append((name, str(before[name]), str(after[name]), *shown, row.unit))
    print("\n".join(aligned([head, *rows], right=range(1, len(head) - 1))))
