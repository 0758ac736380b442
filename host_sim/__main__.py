"""`python -m host_sim`: the same as `tools/octet`, and as the command `octet` of a wheel."""

import gc
import os
import signal
import sys
from collections.abc import Sequence
from typing import NoReturn

_OBJECTS_A_COLLECTION = 10_000


def judge(arguments: Sequence[str]) -> Sequence[str]:
    """As `host_sim.cli.main.judge`."""
    from host_sim.cli.main import judge  # noqa: PLC0415 - as below

    return judge(arguments)


def _end(number: int, _frame: object) -> NoReturn:
    os.write(2, b"octet: interrupted\n")
    os._exit(128 + number)


def main() -> int:
    """Runs the command; until it is loaded, Ctrl-C ends the process at once."""
    gc.set_threshold(_OBJECTS_A_COLLECTION)  # loaded modules are not garbage, and looking for garbage takes time
    interruptible = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if interruptible:
        signal.signal(signal.SIGINT, _end)
    from host_sim.cli.main import main as run  # noqa: PLC0415 - this takes the time

    if interruptible:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    return run()


if __name__ == "__main__":
    sys.exit(main())
