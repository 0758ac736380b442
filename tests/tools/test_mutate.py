"""The C tests kill mutants: a sample of them. And the tool says which are alive, and which are rightly let live."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.tools.mutants_of_text import STANDARD, TEXT, mutants  # noqa: E402 - found by the line above
from tools.verify.command import VerifyError  # noqa: E402
from tools.verify.mutants import runner  # noqa: E402
from tools.verify.mutants.equivalent import Compiler  # noqa: E402
from tools.verify.mutants.sources import MUTATED, Source, group_of  # noqa: E402
from tools.verify.mutants.tree import PLAIN, RUNTIME, SANITIZED  # noqa: E402
from tools.verify.mutants.trial import Trial  # noqa: E402
from tools.verify.mutants.verdicts import Verdict  # noqa: E402

EQUIVALENT = ROOT / "tools" / "verify" / "mutants.toml"

# All that can be mutated, with a number for each result of it.
SOURCE = """#include <stdbool.h>
#include <stdio.h>

enum { LIMIT = 5 };
enum side { LEFT, RIGHT };

static bool is_even(int x)
{
    return x % 2 == 0;
}

static bool is_small(int x)
{
    return is_even(x) && x < LIMIT;
}

static int opposite(enum side side)
{
    if (side == LEFT)
        return RIGHT;
    return LEFT;
}

static int twice(int x)
{
    return is_small(x) ? x * 2 : x << 1;
}

static int of_table(int i)
{
    static const int table[] = {3, 1, 2, 0};

    return table[i];
}

static unsigned sum(int last)
{
    unsigned total = 0;

    for (int i = 0; i < last; i++) {
        if (i == 3)
            continue;
        if (!is_small(i) || i > 7)
            break;
        total += (unsigned)i / 2u + 1u;
        total ^= ~0x10u & 0xFFu;
    }
    return total;
}

int main(void)
{
    for (int i = 0; i < 12; i++)
        printf("%d %d %u %d %d\\n", is_small(i), twice(-i), sum(i), opposite((enum side)(i & 1)), of_table(i % 3));
    return 0;
}
"""


def changes(folder: Path, statement: str) -> set[str]:
    """What one statement becomes: its new texts."""
    text = f"int f(int *p, int a, int b);\nint f(int *p, int a, int b)\n{{\n    {statement}\n    return a < b;\n}}\n"
    found, _ = mutants(folder, text)
    return {mutant.after for mutant in found if mutant.line == 4}


def output(folder: Path, text: str, number: int = 0) -> str:
    """What a program prints, with one mutant acting."""
    (folder / "b.c").write_text(text)
    subprocess.run(("gcc", "-w", "-O1", "-o", "b", "b.c", RUNTIME), cwd=folder, check=True)
    return act(folder, number)


def act(folder: Path, number: int) -> str:
    environment = {**os.environ, "OCTET_MUTANT": str(number), "OCTET_MUTANT_CPU_MS": "200"}
    result = subprocess.run(folder / "b", env=environment, capture_output=True, text=True, check=False)
    return result.stdout if result.returncode == 0 else "failed"


def mutate(*words: object) -> subprocess.CompletedProcess[str]:
    command = [ROOT / "tools" / "mutate", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_a_sample_of_mutants_is_killed():
    result = mutate("--sample", 60)

    assert result.returncode == 0, result.stdout + result.stderr
    assert "60 mutants, 0 groups below their bar, 0 complaints" in result.stdout


def test_without_a_test_its_mutants_live():
    """The canary: a test that is not there is missed."""
    result = mutate("--without", "crash", "hal/port/cortex_m/crash.c", "--sample", 8)

    assert result.returncode == 1
    assert "1 groups below their bar" in result.stdout
    assert "hal/port/cortex_m/crash.c:" in result.stdout


def test_every_source_is_judged_with_some_group():
    files = [path.relative_to(ROOT).as_posix() for top in MUTATED for path in (ROOT / top).rglob("*.c")]

    assert len({group_of(file).name for file in files}) > 1


def test_an_unknown_source_is_refused_with_those_there_are():
    result = mutate("firmware/nothing.c")

    assert result.returncode == 2
    assert "no C test is built from firmware/nothing.c" in result.stderr
    assert "firmware/motion/motion.c" in result.stderr


@pytest.fixture(scope="module")
def listing():
    """What is printed of a sample that is larger than these sources have mutants."""
    result = mutate("--list", "--sample", 1000, "hal/port/cortex_m")
    assert result.returncode == 0, result.stderr
    return result


def test_sources_that_no_c_test_reaches_are_named(listing):
    assert "hal/port/cortex_m/crash.c:" in listing.stdout
    assert "startup.c" not in listing.stdout
    (line,) = [line for line in listing.stderr.splitlines() if "no C test is built from them" in line]
    assert "hal/port/cortex_m/startup.c" in line
    assert "crash.c" not in line
    assert "hal/stm32" not in line


def test_a_sample_has_no_mutant_that_is_listed(listing):
    listed = "note.mark = 0; -> note.mark = (0 + 1);"

    assert listed in EQUIVALENT.read_text()
    assert listed not in listing.stdout
    assert "note.mark = 0; -> (void)0;" in listing.stdout


@pytest.mark.parametrize(
    ("statement", "expected"),
    [
        ("if (a < b) b = a;", {"if (a <= b) b = a;", "if (a != b) b = a;", "if (0) b = a;", "if (a < b) (void)0;"}),
        ("if (a == b) p = 0;", {"if (a <= b) p = 0;", "if (a >= b) p = 0;", "if (0) p = 0;", "if (a == b) (void)0;"}),
        ("if (p == 0) b = a;", {"if (0) b = a;", "if (1) b = a;", "if (p == 0) (void)0;"}),
        ("if (a && b) b = a;", {"if (a || b) b = a;", "if (a) b = a;", "if (b) b = a;", "if (a && b) (void)0;"}),
        ("if (a & 1) b++;", {"if (!(a & 1)) b++;", "if (a | 1) b++;", "if (a & (1 + 1)) b++;"}
         | {"if (a & 1) b--;", "if (a & 1) (void)0;"}),
        ("a = b * 3 - a;", {"a = (b + 3) - a;", "a = b * (3 + 1) - a;", "a = b * 3 + a;", "(void)0;"}),
        ("a = -b >> 2;", {"a = b >> 2;", "a = -b << 2;", "a = -b >> (2 + 1);", "(void)0;"}),
        ("*p++ += !a;", {"*p-- += !a;", "*p++ -= !a;", "*p++ += !!a;", "(void)0;"}),
        ("a = sizeof(int);", {"(void)0;"}),
        ("p = (void *)0;", {"(void)0;"}),
        ("const int one = 1; a += *&one;", {"const int one = (1 + 1); a += *&one;", "const int one = 1; a -= *&one;"}
         | {"const int one = 1; (void)0;"}),
    ],
)  # fmt: skip
def test_each_operator_has_its_mutants(tmp_path, statement, expected):
    assert changes(tmp_path, statement) == expected


def test_a_mutant_acts_among_all_others_as_it_does_alone(tmp_path):
    found, together = mutants(tmp_path, SOURCE, first=7)
    some = found[::4]
    alone = [output(tmp_path, mutant.apply(SOURCE)) for mutant in some]

    assert output(tmp_path, SOURCE) == output(tmp_path, together)
    assert [act(tmp_path, mutant.number) for mutant in some] == alone
    assert len(found) > 50


def test_the_compiler_proves_what_makes_no_difference(tmp_path):
    text = "int f(unsigned x);\nint f(unsigned x)\n{\n    return x > 0u ? 3 : 4;\n}\n"
    found, together = mutants(tmp_path, text)
    source = Source("firmware/a.c", text, STANDARD, found, together)

    same = [mutant.after for mutant in found if Compiler().same_code(source, mutant)]

    assert same == ["return (x != 0u) ? 3 : 4;"]


class NothingIsKilled:
    """A project whose tests let all mutants live."""

    def __init__(self, source):
        self.source = source
        self.builds = []

    def sources(self, _):
        return [self.source]

    def tests(self, build, _):
        self.builds.append(build)
        return self

    def killer(self, _):
        return ""


@pytest.mark.parametrize(("is_enough", "builds"), [(True, [PLAIN]), (False, [PLAIN, SANITIZED])])
def test_sanitizers_are_asked_where_plain_builds_will_not_do(tmp_path, is_enough, builds):
    found, together = mutants(tmp_path, TEXT)
    project = NothingIsKilled(Source("firmware/a.c", TEXT, STANDARD, found, together))

    verdicts = Trial(project, [], lambda _: None).judge(found, lambda _: is_enough)

    assert project.builds == builds
    assert dict(verdicts) == dict.fromkeys(found, Verdict.ALIVE)


class Slow:
    """A program that has not ended when it is asked for the first times."""

    pid = 1

    def __init__(self, times):
        self.times = times

    def wait(self, wait_s):
        self.times -= 1
        if self.times >= 0:
            raise subprocess.TimeoutExpired("slow", wait_s)
        return 0


@pytest.mark.parametrize(("ticks", "code"), [([1, 2, 3], 0), ([1, 2, 2], 1), ([0], 1)])
def test_a_program_has_time_as_long_as_it_goes_on(monkeypatch, ticks, code):
    monkeypatch.setattr(runner, "ticks_used", lambda _: ticks.pop(0))

    assert runner.end(Slow(len(ticks)), 20.0) == code


def test_what_a_program_has_used_of_the_processor_is_counted():
    before = runner.ticks_used(os.getpid())
    while time.process_time() < before / os.sysconf("SC_CLK_TCK") + 0.1:
        pass

    assert runner.ticks_used(os.getpid()) > before


def test_a_source_that_is_no_c_is_an_error(tmp_path):
    with pytest.raises(VerifyError, match="clang cannot read"):
        mutants(tmp_path, "int f(")
