"""A sample of the faults that are planted in a copy of the tree: tests find them."""

import subprocess

import pytest

from tests.planted.__main__ import ROOT, Fault, copy_of_the_tree, faults, is_found

SAMPLE = 2
"""Number of faults of a run; the commit chooses them."""


def chosen() -> list[Fault]:
    """Those whose tests need neither a browser nor what studies need."""
    every = [fault for fault in faults() if not fault.tests.startswith(("tests/web", "tests/lab/study"))]
    head = subprocess.check_output(["git", "-C", ROOT, "rev-parse", "HEAD"], text=True)
    return [every[(int(head, 16) + i * len(every) // SAMPLE) % len(every)] for i in range(SAMPLE)]


@pytest.mark.parametrize("fault", chosen(), ids=lambda fault: fault.file)
def test_a_planted_fault_is_found_and_the_tree_as_it_is_passes(fault):
    with copy_of_the_tree() as tree:
        assert is_found(fault, tree)
        assert not is_found(fault._replace(new=fault.old), tree)
