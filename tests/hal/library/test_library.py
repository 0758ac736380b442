"""What liboctet.so shows to those who load it."""

import subprocess

from host_sim.sim.in_process_link import LIBRARY


def test_library_exports_its_own_functions_only():
    symbols = subprocess.check_output(["nm", "--dynamic", "--defined-only", LIBRARY], text=True)

    names = [line.split()[-1] for line in symbols.splitlines()]

    assert sorted(names) == [f"octet_{name}" for name in ("answers", "close", "exchange", "open", "outage", "size")]
