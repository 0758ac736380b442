"""MISRA's rules, checked by cppcheck's addon."""

import json
import os
import re
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tools.verify.command import VerifyError, output_of

ROOT = Path(__file__).resolve().parents[2]
BUILDS = ("feather_stm32f405", "blue_pill", "nucleo_g431rb")
"""A source that is part of several builds is checked with the options of the first."""

CHECKED = ("firmware", "hal")
CPPCHECK = ROOT / ".venv/bin/cppcheck"
_FINDING = re.compile(r"(?P<file>.+):(?P<line>\d+) misra-c2012-(?P<rule>[\d.]+)$")
_OF_WHOLE_PROGRAMS = {"2.3", "2.4", "2.5", "5.7", "5.9", "8.5", "8.6", "8.7"}
"""Ignored rules about whole programs: cppcheck takes the sources of several programs for one."""
_ERROR = re.compile(r".+ (syntaxError|preprocessorErrorDirective|internalError|internalAstError)$")

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


@dataclass(frozen=True, order=True)
class Finding:
    """A line that violates a rule.

    Attributes:
        rule: Number of the rule, as `15.6`.
        file: File, relative to the project's root.
        line: Line, from 1.
    """

    rule: str
    file: str
    line: int

    @property
    def what(self) -> str:
        """Its description, as tables name it."""
        return f"rule {self.rule}"

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.what}"


def findings(commands: Sequence[Command]) -> list[Finding]:
    """All findings in these sources, each once.

    Raises:
        VerifyError: cppcheck is missing, or does not understand a source.
    """
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder, "compile_commands.json")
        project.write_text(json.dumps(commands))
        output = _run(project, folder)
    found = set()
    for line in output.splitlines():
        if _ERROR.fullmatch(line):
            raise VerifyError(f"cppcheck does not understand {line}")
        if (match := _FINDING.fullmatch(line)) and match["rule"] not in _OF_WHOLE_PROGRAMS:
            found.add(Finding(match["rule"], _relative(match["file"]), int(match["line"])))
    return sorted(found)


def _run(project: Path, scratch: str) -> str:
    kind = ("--addon=misra", "--enable=style", "--std=c99", "--platform=unix32")
    options = (*kind, "--quiet", f"-j{os.cpu_count() or 1}", f"--cppcheck-build-dir={scratch}")
    template = "--template={file}:{line} {id}"
    try:
        command = (CPPCHECK, f"--project={project}", *options, template)
        result = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise VerifyError(f"cannot run cppcheck: {error}; tools/setup misra installs it") from error
    if result.returncode != 0 or "Bailing out" in result.stdout:
        raise VerifyError(f"cppcheck failed: {result.stdout}{result.stderr}")
    return result.stderr


def _relative(file: str) -> str:
    path = Path(file).resolve()
    return str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)
