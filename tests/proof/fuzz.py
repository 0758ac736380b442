"""Fuzzes each part with libFuzzer and sanitizers.

    python -m tests.proof.fuzz [SECONDS] [PART...]

Inputs that reach something new are kept in build/fuzz/PART.corpus, and the next call goes on from there. It ends
with 1 when an input does harm; build/fuzz has that input then.
"""

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from tests.proof.parts import FUZZED, HERE, INCLUDED, ROOT

FOLDER = ROOT / "build/fuzz"
TIMEOUT_S = 10
SANITIZED = ("-g", "-O1", "-std=c99", "-fsanitize=fuzzer,address,undefined", "-fno-sanitize-recover=all")


def build(name: str, sources: Sequence[Path], folder: Path = FOLDER, options: Sequence[str] = ()) -> Path:
    """A program that feeds a harness what the fuzzer thinks up. The options are the compiler's."""
    folder.mkdir(parents=True, exist_ok=True)
    program = folder / name
    files = (HERE / "fuzzed.c", *sources)
    command = ("clang", *SANITIZED, *INCLUDED, *options, *files, "-o", program)
    subprocess.run(command, check=True)
    return program


def fuzz(program: Path, limit: str) -> subprocess.CompletedProcess[str]:
    """Runs it up to a limit of libFuzzer's. What it prints is on stderr."""
    corpus = program.with_suffix(".corpus")
    corpus.mkdir(exist_ok=True)
    limits = (limit, f"-timeout={TIMEOUT_S}", "-rss_limit_mb=512", "-max_len=4096")
    command = (program, *limits, f"-artifact_prefix={program.parent}/", "-print_final_stats=1", corpus)
    return subprocess.run(command, capture_output=True, text=True, check=False)


def main(seconds: str = "60", *names: str) -> int:
    """Returns 0 if no input did harm."""
    harmed = 0
    for name in names or FUZZED:
        ended = fuzz(build(name, [HERE / f"{name}.c", *FUZZED[name]]), f"-max_total_time={seconds}")
        tried = next(line for line in ended.stderr.splitlines() if "number_of_executed_units" in line).split()[-1]
        sys.stdout.write(f"{name:8} {tried} inputs in {seconds} s: {'harm' if ended.returncode else 'no harm'}\n")
        sys.stdout.flush()
        if ended.returncode:
            sys.stderr.write(ended.stderr)
            harmed = 1
    return harmed


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
