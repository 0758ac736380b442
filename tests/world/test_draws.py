"""Random numbers and layouts that are drawn in C: those of Python's random.Random, and the same for ever."""

import random

import pytest

from host_sim.world.world_library import world_library
from tests.world.golden_layouts import DIGESTS, WANTED, digest, numbers, world


def drawn(text: str, count: int) -> list[float]:
    ffi, library = world_library()
    draws = ffi.new("struct draws *")
    library.draws_seed(draws, text.encode())
    return [library.draws_next(draws) for _ in range(count)]


def drawn_by_python(text: str, count: int) -> list[float]:
    draws = random.Random(text)
    return [draws.random() for _ in range(count)]


def test_the_first_numbers_of_many_seeds_are_those_of_python():
    for seed in (*range(2000), -1, 2**32 - 1, 2**63 - 1, -(2**63)):
        text = f"octet {seed} {seed % 7}"

        assert drawn(text, 3) == drawn_by_python(text, 3), text


def test_the_numbers_of_a_text_of_any_length_are_those_of_python():
    for length in range(101):
        text = "".join(chr(33 + (7 * i) % 90) for i in range(length))

        assert drawn(text, 3) == drawn_by_python(text, 3), text


@pytest.mark.parametrize("text", ["octet 1 1", "octet 7 3 starts", ""])
def test_a_long_sequence_is_that_of_python(text):
    assert drawn(text, 10_000) == drawn_by_python(text, 10_000)


@pytest.mark.parametrize("name", DIGESTS)
def test_the_layouts_of_a_world_stay_the_same_for_ever(name):
    assert digest(numbers(world(name).generate(*which)) for which in WANTED) == DIGESTS[name]
