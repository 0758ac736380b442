"""What the commands have in common: their errors, how they run, and what they print."""

import argparse
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence

OUTPUT_MAX = 4000


class VerifyError(Exception):
    """The check cannot be made; the message says why."""


class ChoiceError(VerifyError):
    """What was asked for is not there."""


def parser(name: str, description: str | None) -> argparse.ArgumentParser:
    """The parser of a command, which is named by its path."""
    return argparse.ArgumentParser(
        prog=f"tools/{name}", description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )


def run(name: str, check: Callable[[], Sequence[str]]) -> int:
    """Checks, and prints the complaints; returns the exit code: 0, 1 if there are any, 2 if it was asked wrongly."""
    code = 1
    try:
        complaints = check()
    except VerifyError as error:
        complaints = [str(error)]
        code = 2 if isinstance(error, ChoiceError) else 1
    sys.stderr.writelines(f"{name}: {complaint}\n" for complaint in complaints)
    return code if complaints else 0


def output_of(*command: object, error: type[VerifyError] = VerifyError, env: Mapping[str, str] | None = None) -> str:
    """What a program prints.

    Args:
        command: Its name and arguments.
        error: Raised if it fails.
        env: Its environment; None for this process's.

    Raises:
        VerifyError: It is missing or fails; ends with what it printed last.
    """
    words = [str(word) for word in command]
    try:
        result = subprocess.run(words, capture_output=True, text=True, check=False, env=env)
    except OSError as reason:
        raise error(f"cannot run {words[0]}: {reason}; tools/setup tests installs it") from reason
    if result.returncode != 0:
        raise error(f"{' '.join(words[:3])} failed:\n{(result.stdout + result.stderr)[-OUTPUT_MAX:]}")
    return result.stdout
