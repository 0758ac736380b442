"""Parsing of the command line: one-line error messages, and argument types with ranges."""

import argparse
import math
import os
import re
from collections.abc import Callable, Mapping, Sequence
from copy import copy
from pathlib import Path
from typing import Any, NoReturn, TypeAlias

from host_sim.base.errors import UsageError, meant, near_word
from host_sim.base.files import read_words
from host_sim.base.paths import as_called
from host_sim.protocol.words import PARAMETERS

Subparsers: TypeAlias = "argparse._SubParsersAction[Parser]"
"""The subcommands of a command line."""

DEFAULT = " (default: %(default)s)"
"""The end of the help text of an option that has a default."""

_SETTINGS_MAX = 100_000


class Parser(argparse.ArgumentParser):
    """An argument parser whose errors are one line each.

    Attributes:
        summary: A command's line in the list of commands.
        more: Titles of the groups of options that only --help-all shows.
        more_text: Last lines of its help text that only --help-all shows.
    """

    summary = ""
    more: Sequence[str] = ()
    more_text = ""

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """As in `argparse.ArgumentParser`, but suggests the nearest choice."""
        if action.choices is not None and value not in action.choices:
            raise argparse.ArgumentError(action, f"there is no {value!r}: {meant(value, action.choices)}")

    def _get_value(self, action: argparse.Action, arg_string: str) -> Any:
        """As in `argparse.ArgumentParser`, but names the choices also if the value is not a number."""
        if action.choices is not None and action.type is int and not arg_string.isdecimal():
            choices = ", ".join(map(str, action.choices))
            raise argparse.ArgumentError(action, f"there is no {arg_string!r}: choose from {choices}")
        return super()._get_value(action, arg_string)

    def unknown_option(self, words: Sequence[str]) -> NoReturn:
        """Refuses arguments that no option takes.

        Raises:
            UsageError: Always.
        """
        flag = words[0].partition("=")[0]
        options = re.findall(r"--[\w-]+", self.format_help())
        near = near_word(flag, options) if flag.startswith("-") else f"--log {flag}" if "--log" in options else None
        self.error(f"unrecognized arguments: {' '.join(words)}" + (f": did you mean {near}?" if near else ""))

    def shorten_help(self, groups: Sequence[str], text: str) -> None:
        """Shows these groups of options and these last lines with --help-all only."""
        self.more, self.more_text = groups, text
        self.add_argument("--help-all", action=_HelpAll, nargs=0, help="show every option and parameter, and exit")

    def format_help(self) -> str:
        """As in `argparse.ArgumentParser`, with commands named as in this installation."""
        it = copy(self)
        it.epilog = "\n\n".join(filter(None, [self.more_text, self.epilog]))
        return as_called(super(Parser, it).format_help())

    def print_help(self, file: Any = None) -> None:
        """As in `argparse.ArgumentParser`, but raises an OSError if the output is full."""
        it = copy(self)
        it._action_groups = [group for group in self._action_groups if group.title not in self.more]
        print(as_called(super(Parser, it).format_help()), end="", file=file, flush=True)

    def error(self, message: str) -> NoReturn:
        """As in `argparse.ArgumentParser`, but raises instead of exiting.

        Raises:
            UsageError: Always.
        """
        message = message.replace("ignored explicit argument", "it takes no value, such as")
        raise UsageError(f"{message}; see {self.prog} --help")


class _HelpAll(argparse.Action):
    def __call__(self, parser: Any, *_: object) -> None:
        print(parser.format_help(), end="", flush=True)
        parser.exit()


def add_command(  # noqa: PLR0913 - what a command's help is made of
    commands: Subparsers,
    name: str,
    run: Callable[[argparse.Namespace], int],
    *,
    summary: str,
    description: str,
    epilog: str = "",
    check: Callable[[argparse.Namespace], object] = lambda _: None,
    stages: Callable[[argparse.Namespace], Sequence[str]] = lambda _: ["run"],
) -> Parser:
    """Adds a subcommand.

    Args:
        commands: The subcommands of the command line.
        name: Name of the subcommand.
        run: Runs it, and returns the exit code.
        summary: Its line in the list of commands.
        description: First lines of its help text.
        epilog: Last lines of its help text, such as examples.
        check: Raises UsageError if the options contradict each other. It runs before anything is set up, with the
            standard library only.
        stages: The stages of tools/setup that the options need.

    Returns:
        The subcommand's parser, to which options can be added.
    """
    formatter = argparse.RawDescriptionHelpFormatter
    parser = commands.add_parser(
        name, description=description, epilog=epilog, formatter_class=formatter, allow_abbrev=False
    )
    parser.summary = summary
    parser.set_defaults(command=run, check=check, stages=stages, parser=parser)
    return parser


def number(low: float, high: float, kind: type[int] | type[float] = int) -> Callable[[str], int | float]:
    """An argument type: a number from `low` to `high`."""

    def parse(text: str) -> int | float:
        try:
            value = kind(text)
        except ValueError:
            value = math.nan
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text!r} is not a number from {low:.10g} to {high:.10g}")
        return value

    return parse


def file_path(text: str) -> Path:
    """An argument type: the name of a file or folder, not empty (as from an unset shell variable)."""
    if not text:
        raise argparse.ArgumentTypeError("the file name is empty")
    return Path(text)


def word_or_file(words: Sequence[str], endings: tuple[str, ...]) -> Callable[[str], str]:
    """An argument type: one of these words, or the name of a file with one of these endings."""

    def parse(text: str) -> str:
        if text in words or text.endswith(endings):
            return text
        files = " or ".join(endings)
        raise argparse.ArgumentTypeError(f"there is no {text!r}: {meant(text, words)}, or name a {files} file")

    return parse


def output_of(*endings: str) -> Callable[[str], Path]:
    """An argument type: the name of a file to write, with one of these endings or none."""

    def parse(text: str) -> Path:
        path = file_path(text)
        if path.suffix and path.suffix.lower() not in endings:
            raise argparse.ArgumentTypeError(f"{text!r} does not end with {' or '.join(endings)}")
        return path

    return parse


def check_outputs(command: str, source: Path | None, outputs: Mapping[str, Path | None]) -> None:
    """Refuses outputs that cannot be written, that would overwrite the input, or that share one file.

    Args:
        command: Name of the command.
        source: The file that it reads, if any.
        outputs: The files to write, by the options that name them; None if not wanted.

    Raises:
        UsageError: A file cannot be written, or two names mean the same file; nothing was changed.
    """
    options: dict[str, str] = {}
    for option, path in ((option, path) for option, path in outputs.items() if path is not None):
        target = os.path.realpath(path)  # not Path.resolve: that fails for a link to itself
        if not Path(target).parent.is_dir():
            raise UsageError(f"cannot write {path}: there is no folder {path.parent}")
        if Path(target).is_dir():
            raise UsageError(f"cannot write {path}: it is a folder")
        if Path(target).is_symlink():
            raise UsageError(f"cannot write {path}: it is a link to itself")
        if source is not None and target == os.path.realpath(source):
            raise UsageError(f"{path} is the input of {command}: choose another file with {option}")
        if target in options:
            raise UsageError(f"{options[target]} and {option} name the same file: {path}")
        options[target] = option


def settings(text: str) -> dict[str, int]:
    """An argument type: NAME=VALUE for a parameter, or @FILE with one per line.

    Raises:
        UsageError: There is no such parameter, the value is out of range, or the file cannot be read.
    """
    if text.startswith("@"):
        return dict(read_words(Path(text[1:]), _SETTINGS_MAX, _setting))
    return dict([_setting(text)])


def _setting(text: str) -> tuple[str, int]:
    name, equals, value = text.partition("=")
    if name not in PARAMETERS:
        raise UsageError(f"unknown parameter {name!r}: {meant(name, PARAMETERS)}")
    _, low, high, _, unit, _ = PARAMETERS[name]
    values = f"a whole number from {low} to {high}{f' {unit}' if unit else ''}"
    if not equals:
        raise UsageError(f"{name} has no value: write --set {name}=VALUE, {values}")
    if not value.isdecimal() or not low <= int(value) <= high:
        raise UsageError(f"{name} must be {values}, not {value!r}")
    return name, int(value)


def parameter_table() -> str:
    """Every parameter with its range, unit, default and meaning, for a help text."""
    lines = ["parameters for --set:"]
    for name, parameter in PARAMETERS.items():
        values = f"{parameter.minimum}..{parameter.maximum} {parameter.unit}"
        default = f"(default: {parameter.default})"
        lines.append(f"  {name:16}  {values:16}  {default:14}  {parameter.comment}")
    return "\n".join(lines)
