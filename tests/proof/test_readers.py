"""Whatever is in a file, an order of the page or a rule: it is read, or refused with an error that a user can read.

Each reader gets samples with random damage; `python -m tests.proof.fuzz` goes on with that for as long as one wants.
"""

from itertools import count

import pytest

from host_sim.base.errors import OctetError
from tests.proof import reader_fuzzer
from tests.proof.reader_fuzzer import ReaderFuzzer, harm
from tests.proof.readers import READERS, Reader

FEW = 100
FEWER = 20
SLOW = ("dbc", "words")
"""These two are read together."""


@pytest.mark.parametrize("name", READERS)
def test_what_is_damaged_is_read_or_refused_in_one_line(tmp_path, name):
    most = FEWER if name in SLOW else FEW

    done = ReaderFuzzer(READERS[name], tmp_path, seed=1).run(lambda tried: tried < most)

    assert done.words == ""
    assert done.tried == most


@pytest.mark.parametrize("name", READERS)
def test_the_samples_themselves_are_read(tmp_path, name):
    for sample in READERS[name].samples:
        READERS[name].read(sample, tmp_path)


def chokes(data, _folder):
    if b"NaN" in data:
        raise ZeroDivisionError("not a number")
    if b"{" in data:
        raise OctetError("two\nlines")
    if b"true" in data:
        while True:
            pass


def fuzz_a_little(reader, folder, seed):
    return ReaderFuzzer(reader, folder, seed).run(lambda tried: tried < 1000)


@pytest.mark.parametrize("trouble", ["ZeroDivisionError: not a number", "not one line", "no end within"])
def test_what_can_go_wrong_is_found_and_kept(tmp_path, monkeypatch, trouble):
    monkeypatch.setattr(reader_fuzzer, "TIMEOUT_S", 0.2)
    reader = Reader([b"a = 1\n"], chokes)
    seeds = count()

    done = next(
        done for seed in seeds if trouble in (done := fuzz_a_little(reader, tmp_path / f"{seed}", seed)).words
    )

    assert trouble in harm(reader, done.find.read_bytes(), tmp_path)


def test_inputs_that_take_new_ways_are_kept_for_the_next_call(tmp_path):
    reader = READERS["order"]
    first = ReaderFuzzer(reader, tmp_path, seed=1).run(lambda tried: tried < FEW)

    again = ReaderFuzzer(reader, tmp_path, seed=1).run(lambda _: False)

    assert first.corpus > 1
    assert again.steps == first.steps
