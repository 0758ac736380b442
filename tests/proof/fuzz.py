"""Fuzzes code that reads input: parsers and sessions in C with libFuzzer and sanitizers, readers in Python likewise.

    python -m tests.proof.fuzz                        a minute for each
    python -m tests.proof.fuzz --hours 1 wire world   an hour for each of these
    python -m tests.proof.fuzz --list                 what there is
    python -m tests.proof.fuzz --repeat out/fuzz/wire/finds/crash-...   what an input does

For each, out/fuzz/NAME/corpus keeps the inputs with new coverage, and the next call continues from there; inputs that
do harm are kept in out/fuzz/NAME/finds. Exit code 1 if any did.
"""

import argparse
import logging
import shutil
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from tests.proof import c_fuzzer
from tests.proof.c_fuzzer import Compiler
from tests.proof.parts import FUZZED, GENERATED, HERE, ROOT
from tests.proof.readers import READERS, ReaderFuzzer, harm, lasting

FOLDER = ROOT / "out/fuzz"
TARGETS = (*FUZZED, *READERS)


class Done(NamedTuple):
    """The result of fuzzing a target: in words, the input that did harm if there is one, and what it did."""

    words: str
    find: Path | None
    harm: str


class Fuzzer:
    """Fuzzes targets one after another."""

    def __init__(self, folder: Path, seconds: float, scratch: Path) -> None:
        """Builds nothing yet.

        Args:
            folder: Has a folder for each target.
            seconds: For each.
            scratch: For files that nobody needs afterwards.
        """
        self._folder = folder
        self._seconds = seconds
        self._scratch = scratch
        self._compiler = Compiler(folder, scratch)

    def fuzz(self, name: str) -> Done:
        """Fuzzes a target."""
        return self._fuzz_c(name) if name in FUZZED else self._fuzz_reader(name)

    def repeat(self, name: str, find: Path) -> str:
        """What an input does, in words; empty if it does no harm."""
        if name in READERS:
            return harm(READERS[name], find.read_bytes(), self._scratch)
        ended = c_fuzzer.repeat(self._program(name), find)
        return ended.stderr if ended.returncode else ""

    def _fuzz_c(self, name: str) -> Done:
        program = self._program(name)
        ended = c_fuzzer.fuzz(program, f"-max_total_time={max(round(self._seconds), 1)}")
        if ended.returncode:
            return Done("stopped", c_fuzzer.find_in(ended.stderr), ended.stderr)
        return Done(f"{c_fuzzer.figures(ended.stderr)}, {c_fuzzer.thin_out(program)} kept", None, "")

    def _fuzz_reader(self, name: str) -> Done:
        fuzzer = ReaderFuzzer(READERS[name], self._folder / name, seed=time.time_ns())
        done = fuzzer.run(lasting(self._seconds))
        return Done(f"{done.tried} inputs, {done.steps} steps, {done.corpus} kept", done.find, done.words)

    def _program(self, name: str) -> Path:
        return self._compiler.build(name, [HERE / f"{name}.c", *FUZZED[name]])


def is_find(path: Path) -> bool:
    """Whether it is an input that is kept in a target's folder."""
    return path.is_file() and path.resolve().parent.parent.name in TARGETS


def arguments(words: Sequence[str]) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.proof.fuzz", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = parser.add_argument
    add("targets", nargs="*", metavar="TARGET", help=f"default: all of {', '.join(TARGETS)}")
    add("--seconds", type=float, default=0.0, metavar="S", help="for each target")
    add("--minutes", type=float, default=0.0, metavar="M", help="and so many minutes (default: 1 in all)")
    add("--hours", type=float, default=0.0, metavar="H", help="and so many hours")
    add("--folder", type=Path, default=FOLDER, help="where corpora and finds are kept (default: out/fuzz)")
    add("--repeat", type=Path, metavar="FILE", help="feed a find to the target whose folder it is in")
    add("--list", action="store_true", help="print the targets and end")
    options = parser.parse_args(words)
    unknown = [name for name in options.targets if name not in TARGETS]
    if unknown:
        parser.error(f"no target {', '.join(unknown)}; there are {', '.join(TARGETS)}")
    if options.repeat and not is_find(options.repeat):
        parser.error(f"{options.repeat} is not a file in the folder of a target, as out/fuzz/wire/finds/crash-...")
    return options


def fuzz_all(fuzzer: Fuzzer, names: Sequence[str]) -> int:
    """Returns 0 if no input did harm."""
    harmed = 0
    for name in names:
        sys.stdout.write(f"{name:10} ")
        sys.stdout.flush()
        done = fuzzer.fuzz(name)
        sys.stdout.write(f"{done.words}: {'HARM' if done.harm else 'no harm'}\n")
        if done.harm:
            harmed = 1
            sys.stdout.write(f"{done.harm}\nto repeat: python -m tests.proof.fuzz --repeat {done.find}\n")
        sys.stdout.flush()
    return harmed


def repeat(fuzzer: Fuzzer, find: Path) -> int:
    """Returns 0 if the input does no harm."""
    harmful = fuzzer.repeat(find.parent.parent.name, find)
    sys.stdout.write(f"{harmful or 'no harm'}\n")
    return 1 if harmful else 0


def main(*words: str) -> int:
    """Returns 0 if no input did harm."""
    options = arguments(words)
    if options.list:
        sys.stdout.writelines(f"{name}\n" for name in TARGETS)
        return 0
    seconds = options.seconds + 60 * options.minutes + 3600 * options.hours or 60.0
    folder = options.folder.resolve()
    if not (GENERATED / "octet.h").is_file() or not shutil.which("clang"):
        sys.stderr.write("fuzz: clang or the generated sources are missing: run tools/setup python\n")
        return 1
    with tempfile.TemporaryDirectory() as scratch:
        fuzzer = Fuzzer(folder, seconds, Path(scratch))
        try:
            if options.repeat:
                return repeat(fuzzer, options.repeat.resolve())
            return fuzz_all(fuzzer, options.targets or TARGETS)
        except KeyboardInterrupt:
            sys.stderr.write(f"fuzz: stopped; {folder} has what was found until then\n")
            return 130


if __name__ == "__main__":
    logging.disable()  # python-can's words about each damaged file
    sys.exit(main(*sys.argv[1:]))
