"""A sample of the soak; hours of it are run by name, as its module says."""

import subprocess
import sys

from tests.runs.support import ROOT


def test_neither_time_nor_starts_make_anything_grow():
    command = [sys.executable, "-m", "tests.runs.endurance.soak", "0.04", "--step", "0.02", "--starts", "20"]

    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)

    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert done.stdout.count(" h  ") == 2
