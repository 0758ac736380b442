"""A sample of the runs that are ended in every way; the whole is run by name, as its module says."""

import subprocess
import sys

from tests.runs.support import ROOT


def test_however_a_run_is_ended_the_last_lesson_is_in_the_memory_file():
    command = [sys.executable, "-m", "tests.runs.endurance.kills", "4"]

    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)

    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert done.stdout.count(" 0 lost\n") == 8
