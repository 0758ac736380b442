"""`python -m host_sim`: the same as `tools/octet`, and as the command `octet` of a wheel."""

import gc
import signal
import sys
from collections.abc import Sequence

_OBJECTS_A_COLLECTION = 10_000


def judge(arguments: Sequence[str]) -> Sequence[str]:
    """As `host_sim.cli.main.judge`."""
    from host_sim.cli.main import judge  # noqa: PLC0415 - as below

    return judge(arguments)


def main() -> int:
    """Runs the command; until it is loaded, Ctrl-C ends the process without a traceback."""
    gc.set_threshold(_OBJECTS_A_COLLECTION)  # loaded modules are not garbage, and looking for garbage takes time
    interruptible = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if interruptible:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from host_sim.cli.main import main as run  # noqa: PLC0415 - this takes the time

    if interruptible:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    return run()


if __name__ == "__main__":
    sys.exit(main())
