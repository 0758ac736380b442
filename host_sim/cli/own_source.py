"""The user's behaviour of a recorded robot: from the file named by --profile, or from the log's world file.

C source that came with a log is compiled only with --compile. A program is interpreted, which is safe.
"""

import argparse
import shlex
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.cli.parsing import file_path
from host_sim.sim.run_config import C_FILE, PROGRAM_FILE

if TYPE_CHECKING:
    from host_sim.protocol.codec import Frame, Protocol
    from host_sim.sim.in_process_link import Program
    from host_sim.sim.own_brain import OwnBrain
    from host_sim.sim.world_record import WorldRecord


def add_source_options(parser: argparse.ArgumentParser) -> None:
    """Adds the options that say where the source is."""
    add = parser.add_argument
    add("--profile", type=file_path, metavar="FILE", help="the C file or program that was the robot's behaviour")
    trusted = "if it was a C file: compile and run its source as it came with the log"
    add("--compile", action="store_true", help=trusted)


def log_words(log: Path, profile: str | Path | None) -> str:
    """The arguments of `tools/octet debug` for a log: its path, and --profile if the behaviour was a C file."""
    file = str(profile or "")
    return shlex.join([str(log), *(["--profile", file] if file.endswith(C_FILE) else [])])


def own_of(arguments: argparse.Namespace, record: "WorldRecord | None") -> "OwnBrain | Program | None":
    """The behaviour, compiled if it is in C; None if the options and the world file name none.

    Raises:
        UsageError: It cannot be compiled; or neither --profile nor --compile is given for a recorded C file.
    """
    from host_sim.sim.in_process_link import Program, read_program
    from host_sim.sim.own_brain import own_brain, own_copy

    recorded = record.own if record else None
    if arguments.profile:
        is_program = arguments.profile.suffix == PROGRAM_FILE
        own = read_program(arguments.profile) if is_program else own_brain(arguments.profile)
        if recorded and own.source.sha256 != recorded.sha256:
            sys.stderr.write(f"octet: {arguments.profile} differs from {recorded}, which the robot had\n")
        return own
    if recorded is None:
        return None
    if recorded.name.endswith(PROGRAM_FILE):
        return Program(recorded.name, recorded.text)
    if arguments.compile:
        return own_copy(recorded)
    trusted = "or, if you trust those who sent the log, --compile, which takes the source that came with it"
    raise UsageError(f"the robot in {arguments.log} had {recorded}: add --profile and this file; {trusted}")


def check_own(arguments: argparse.Namespace, frames: "Iterable[Frame]", protocol: "Protocol") -> None:
    """Refuses a robot that was started with a user's behaviour, because its source is unknown.

    Raises:
        UsageError: A command in the log starts that profile.
    """
    from host_sim.protocol.generated import OWN_PROFILE

    commands = (protocol.decode(frame) for frame in frames if frame.id == protocol.id_of("COMMAND"))
    if any(it and it.signals.get("profile") == OWN_PROFILE for it in commands):
        raise UsageError(f"the robot in {arguments.log} had a behaviour of its own: add --profile MINE.C, its file")
