"""Common parts of the verification commands: errors, argument parser, exit codes and subprocesses."""

import argparse
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence

OUTPUT_MAX = 4000


class VerifyError(Exception):
    """The check cannot be made; the message says why."""


class ChoiceError(VerifyError):
    """The requested item does not exist."""


def parser(name: str, description: str | None) -> argparse.ArgumentParser:
    """The argument parser of the command tools/NAME."""
    return argparse.ArgumentParser(
        prog=f"tools/{name}", description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )


def run(name: str, check: Callable[[], Sequence[str]]) -> int:
    """Runs a check and prints its complaints; returns the exit code: 0, 1 for complaints, 2 for a wrong request."""
    code = 1
    try:
        complaints = check()
    except VerifyError as error:
        complaints = [str(error)]
        code = 2 if isinstance(error, ChoiceError) else 1
    sys.stderr.writelines(f"{name}: {complaint}\n" for complaint in complaints)
    return code if complaints else 0


def output_of(*command: object, env: Mapping[str, str] | None = None) -> str:
    """Runs a program and returns its standard output.

    Args:
        command: Program and arguments.
        env: Environment; None for this process's.

    Raises:
        VerifyError: The program is missing or fails; the message ends with its last output.
    """
    words = [str(word) for word in command]
    try:
        result = subprocess.run(words, capture_output=True, text=True, check=False, env=env)
    except OSError as reason:
        raise VerifyError(f"cannot run {words[0]}: {reason}; tools/setup tests installs it") from reason
    if result.returncode != 0:
        raise VerifyError(f"{' '.join(words[:3])} failed:\n{(result.stdout + result.stderr)[-OUTPUT_MAX:]}")
    return result.stdout
