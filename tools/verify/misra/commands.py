"""Compile commands of the sources to check."""

import json
from collections.abc import Sequence
from pathlib import Path

from tools.verify.command import output_of

ROOT = Path(__file__).resolve().parents[3]
BUILDS = ("feather_stm32f405", "blue_pill", "nucleo_g431rb")
"""A source that is part of several builds is checked with the options of the first."""

CHECKED = ("firmware", "hal")


Command = dict[str, str]
"""An entry of a compilation database: directory, command and file."""


def built_sources() -> list[Command]:
    """The compile commands of all our sources in the builds, one for each source.

    Raises:
        VerifyError: A build is missing.
    """
    commands: dict[Path, Command] = {}
    for build in BUILDS:
        for command in _commands_of(ROOT / "build" / build):
            source = Path(command["directory"], command["file"]).resolve()
            if source.is_relative_to(ROOT) and source.relative_to(ROOT).parts[0] in CHECKED:
                commands.setdefault(source, {**command, "file": str(source)})
    return list(commands.values())


def lone_sources(sources: Sequence[Path]) -> list[Command]:
    """A compile command for each of these sources, without a build."""
    return [
        {"directory": str(ROOT), "command": f"cc -std=c99 -I{ROOT} -c {source}", "file": str(source.resolve())}
        for source in sources
    ]


def _commands_of(build: Path) -> list[Command]:
    listed: list[Command] = json.loads(output_of("ninja", "--quiet", "-C", build, "-t", "compdb"))
    return [command for command in listed if command["file"].endswith(".c")]
