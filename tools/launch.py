"""Checks a command line before anything is installed or built: help and mistakes need no set-up.

The plain python3 runs `tools/launch.py PACKAGE WORD...`. The package's `judge` names the stages of tools/setup that
the words need; these are set up, and `python -m PACKAGE WORD...` of .venv takes over.
"""

import importlib
import os
import signal
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))  # noqa: PTH100, PTH120 - older ones get this far, too
OLDEST = (3, 10)


def main() -> int:
    """Returns an exit code, unless the program takes over."""
    package, words = sys.argv[1], sys.argv[2:]
    if sys.version_info < OLDEST:
        version, oldest = sys.version.split()[0], ".".join(map(str, OLDEST))
        sys.stderr.write("octet: python3 must be %s or newer; here it is %s\n" % (oldest, version))  # noqa: UP031
        return 1
    sys.path.insert(0, ROOT)
    stages = importlib.import_module(package + ".__main__").judge(words)
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    code = subprocess.call([ROOT + "/tools/setup", *stages])
    if code != 0:
        return code
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # container images set it, and each start would compile anew
    os.environ["PYTHONSAFEPATH"] = "1"
    python = ROOT + "/.venv/bin/python"
    return os.execv(python, [python, "-m", package, *words])


if __name__ == "__main__":
    sys.exit(main())
