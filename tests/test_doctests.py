"""The examples in docstrings do what they say."""

import doctest
import importlib
import pkgutil

import pytest

import host_sim

MODULES = [
    info.name
    for info in pkgutil.walk_packages(host_sim.__path__, "host_sim.")
    if ">>>" in (importlib.util.find_spec(info.name).loader.get_source(info.name) or "")
]


def failures_in(module: object) -> int:
    return doctest.testmod(module, report=False).failed


def test_there_are_examples():
    assert {"host_sim.sim.make", "host_sim.world.arena", "host_sim.world.body", "host_sim.world.layouts"} <= set(
        MODULES
    )


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_of_a_module_hold(name):
    assert failures_in(importlib.import_module(name)) == 0


def test_an_example_that_does_not_hold_is_noticed(capsys):
    wrong = type(doctest)("wrong", "An example.\n\n>>> 1 + 1\n3\n")

    assert failures_in(wrong) == 1
    capsys.readouterr()
