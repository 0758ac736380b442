"""A little fuzzing of each part in C; `python -m tests.proof.fuzz` does more."""

from itertools import count

import pytest

from host_sim.base.errors import OctetError
from tests.proof import c_fuzzer, fuzz, readers
from tests.proof.c_fuzzer import Compiler
from tests.proof.parts import FUZZED, HERE, PARTS
from tests.proof.readers import READERS, Reader, ReaderFuzzer, harm

FEW = ("-runs=20000", "-seed=1")
FEWER = ("-runs=5000", "-seed=1")
"""For parts that are also proved, or that take long."""


@pytest.fixture(scope="module")
def compiler(tmp_path_factory):
    return Compiler(tmp_path_factory.mktemp("fuzz"), tmp_path_factory.mktemp("objects"))


@pytest.mark.parametrize("name", FUZZED)
def test_fuzzing_finds_no_fault_in_a_part(compiler, name):
    program = compiler.build(name, [HERE / f"{name}.c", *FUZZED[name]])

    few = FEWER if name in (*PARTS, "boot") else FEW

    ended = c_fuzzer.fuzz(program, *few)

    assert ended.returncode == 0, ended.stderr
    assert f"Done {few[0].partition('=')[2]} runs" in ended.stderr


@pytest.mark.parametrize(
    ("body", "found"),
    [
        ("static int table[4]; if (any_u8() == 77) table[any_u8()] = 1;", "out of bounds"),
        ("int sum = 2147483640; sum += any_u8();", "signed integer overflow"),
        ("while (any_u8() != 9) ;", "timeout"),
    ],
)
def test_fuzzer_finds_overrun_overflow_and_endless_loop(body, found, tmp_path, monkeypatch):
    monkeypatch.setattr(c_fuzzer, "TIMEOUT_S", 1)
    canary = tmp_path / "canary.c"
    canary.write_text(f'#include "tests/proof/any/any.h"\nvoid exercise(void)\n{{\n{body}\n}}\n')

    ended = c_fuzzer.fuzz(Compiler(tmp_path, tmp_path).build("canary", [canary]), *FEW)

    assert ended.returncode != 0
    assert found in ended.stderr
    assert c_fuzzer.find_in(ended.stderr).parent == tmp_path / "canary/finds"


RESPOND = """
#include "firmware/robot.h"
void __real_robot_respond(struct robot *, enum input_kind, const struct input *, struct output *);
void __wrap_robot_respond(struct robot *robot, enum input_kind kind, const struct input *in, struct output *out)
{
    __real_robot_respond(robot, kind, in, out);
    FAULT
}
"""
FITS = """
#include "firmware/config.h"
bool __wrap_config_fits(uint8_t parameter, uint32_t value)
{
    return parameter < PARAMETER_COUNT && value < 256;
}
"""
WRITE = """
#include "hal/flash_store/flash.h"
int __real_flash_write(unsigned, uint32_t, const uint32_t[], uint32_t);
int __wrap_flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    (void)__real_flash_write(page, offset, words, count);
    return 0;
}
"""


@pytest.mark.parametrize(
    ("name", "function", "lines"),
    [
        (
            "session",
            "robot_respond",
            RESPOND.replace("FAULT", "if (kind == INPUT_PEER) robot->brain.memory.cell[1] = SIDE_LEFT;"),
        ),
        (
            "session",
            "robot_respond",
            RESPOND.replace("FAULT", "if (kind == INPUT_SENSES && !robot->running) out->drive.right_mm_s = 1;"),
        ),
        ("commands", "robot_respond", RESPOND.replace("FAULT", "out->drive.right_mm_s = robot->config.value[0];")),
        ("commands", "config_fits", FITS),
        ("flash", "flash_write", WRITE),
    ],
)
def test_fuzzer_finds_planted_faults(compiler, tmp_path, name, function, lines):
    wrong = tmp_path / "wrong.c"
    wrong.write_text(lines)
    sources = [HERE / f"{name}.c", wrong, *FUZZED[name]]
    program = compiler.build(f"wrong_{name}", sources, [f"-Wl,--wrap={function}"])

    ended = c_fuzzer.fuzz(program, *FEW)

    assert ended.returncode != 0
    assert "deadly signal" in ended.stderr


def test_targets_are_fuzzed_by_name_and_a_kept_input_is_repeated(tmp_path, capsys):
    assert fuzz.main("--seconds", "1", "memory", "slcan", "--folder", str(tmp_path)) == 0
    assert "no harm" in capsys.readouterr().out
    kept = next((tmp_path / "slcan/corpus").iterdir())
    assert fuzz.main("--repeat", str(kept), "--folder", str(tmp_path)) == 0


def test_unknown_target_is_refused_with_the_known_ones(capsys):
    with pytest.raises(SystemExit):
        fuzz.main("wires")
    assert "no target wires; there are core, " in capsys.readouterr().err


def test_crash_is_printed_with_the_command_that_repeats_it(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(fuzz.READERS, "memory", Reader([b"\0"], lambda data, _folder: 1 / data[0]))

    assert fuzz.main("memory", "--seconds", "1", "--folder", str(tmp_path)) == 1

    find = next((tmp_path / "memory/finds").iterdir())
    shown = capsys.readouterr().out
    assert f"ZeroDivisionError: division by zero\nto repeat: python -m tests.proof.fuzz --repeat {find}\n" in shown
    assert fuzz.main("--repeat", str(find)) == 1


FEW_BYTES = 100
FEWER_BYTES = 20
SLOW = ("dbc", "words")
"""These two are read together."""


@pytest.mark.parametrize("name", READERS)
def test_damaged_input_is_read_or_refused_in_one_line(tmp_path, name):
    most = FEWER_BYTES if name in SLOW else FEW_BYTES

    done = ReaderFuzzer(READERS[name], tmp_path, seed=1).run(lambda tried: tried < most)

    assert done.words == ""
    assert done.tried == most


@pytest.mark.parametrize("name", READERS)
def test_undamaged_samples_are_read(tmp_path, name):
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
def test_reader_fuzzer_finds_and_keeps_each_kind_of_failure(tmp_path, monkeypatch, trouble):
    monkeypatch.setattr(readers, "TIMEOUT_S", 0.2)
    reader = Reader([b"a = 1\n"], chokes)
    seeds = count()

    done = next(
        done for seed in seeds if trouble in (done := fuzz_a_little(reader, tmp_path / f"{seed}", seed)).words
    )

    assert trouble in harm(reader, done.find.read_bytes(), tmp_path)


def test_inputs_with_new_coverage_are_kept_for_the_next_call(tmp_path):
    reader = READERS["order"]
    first = ReaderFuzzer(reader, tmp_path, seed=1).run(lambda tried: tried < FEW_BYTES)

    again = ReaderFuzzer(reader, tmp_path, seed=1).run(lambda _: False)

    assert first.corpus > 1
    assert again.steps == first.steps
