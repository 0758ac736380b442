"""Builds and runs libFuzzer on the harnesses in C, with sanitizers."""

import re
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

from tests.proof.parts import HERE, INCLUDED, ROOT

TIMEOUT_S = 10
SANITIZED = ("-g", "-O1", "-std=c99", "-fsanitize=fuzzer,address,undefined", "-fno-sanitize-recover=all")


class Compiler:
    """Compiles each source once, however many programs it is part of."""

    def __init__(self, folder: Path, scratch: Path) -> None:
        """Compiles nothing yet.

        Args:
            folder: For programs, each in a folder of its own.
            scratch: For what they are linked from; nobody else's.
        """
        self._folder = folder
        self._scratch = scratch
        self._objects: dict[Path, Path] = {}

    def build(self, name: str, sources: Sequence[Path], options: Sequence[str] = ()) -> Path:
        """A program that feeds a harness the fuzzer's inputs. The options are the linker's."""
        program = self._folder / name / "program"
        program.parent.mkdir(parents=True, exist_ok=True)
        objects = [self._object(source) for source in (HERE / "fuzzed.c", *sources)]
        subprocess.run(("clang", *SANITIZED, *options, *objects, "-o", program), check=True)
        return program

    def _object(self, source: Path) -> Path:
        if source not in self._objects:
            made = self._scratch / f"{len(self._objects)}.o"
            subprocess.run(("clang", *SANITIZED, *INCLUDED, "-c", source, "-o", made), check=True)
            self._objects[source] = made
        return self._objects[source]


def fuzz(program: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Runs it with options of libFuzzer's, of which one limits it, from its corpus on. What it prints is on stderr.

    It begins with an empty corpus: with frames of a real run it reaches no more in the same time, as they are long.
    """
    corpus, finds = (_beside(program, name) for name in ("corpus", "finds"))
    limits = (*options, "-rss_limit_mb=512", "-max_len=4096", "-print_final_stats=1")
    return _run(program, *limits, f"-artifact_prefix={finds}/", corpus)


def repeat(program: Path, find: Path) -> subprocess.CompletedProcess[str]:
    """Feeds it one input."""
    return _run(program, find)


def thin_out(program: Path) -> int:
    """Reduces a corpus to the smallest inputs with the same coverage; returns their number."""
    corpus = _beside(program, "corpus")
    merged = program.parent / "merged"
    shutil.rmtree(merged, ignore_errors=True)
    merged.mkdir()
    subprocess.run((program, "-merge=1", merged, corpus), capture_output=True, check=True)
    shutil.rmtree(corpus)
    merged.rename(corpus)
    return sum(1 for _ in corpus.iterdir())


def figures(report: str) -> str:
    """What a run did, in words: libFuzzer's last line about coverage."""
    tried = next(line for line in report.splitlines() if "number_of_executed_units" in line).split()[-1]
    words = [line.split() for line in report.splitlines() if " cov: " in line][-1]
    return f"{tried} inputs, {words[words.index('cov:') + 1]} edges, {words[words.index('ft:') + 1]} features"


def find_in(report: str) -> Path | None:
    """The file with the input that did harm, if one was written."""
    found = re.search(r"Test unit written to (\S+)", report)
    return Path(found[1]) if found else None


def _run(program: Path, *words: object) -> subprocess.CompletedProcess[str]:
    command = (program, f"-timeout={TIMEOUT_S}", *map(str, words))
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)


def _beside(program: Path, name: str) -> Path:
    folder = program.parent / name
    folder.mkdir(exist_ok=True)
    return folder
