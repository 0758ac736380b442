"""Runs test programs with one mutant acting in them, until one of them fails."""

import contextlib
import os
import re
import signal
import subprocess
import tempfile
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

from tools.verify.command import VerifyError
from tools.verify.mutants.schemata import Mutant
from tools.verify.mutants.tree import Test

CPU_MS = 300
CPU_FACTOR = 4
WAIT_S = 20.0
WAIT_FACTOR = 10.0
FIRST_WAIT_S = 120.0
FIRST_CPU_MS = "120000"


class RunError(VerifyError):
    """The tests fail with no mutant acting; says which."""


class Runner:
    """The tests of one build."""

    def __init__(self, tests: Sequence[Test], highest: int) -> None:
        """Runs each test with no mutant acting.

        Args:
            tests: All of them.
            highest: The highest number of a mutant.

        Raises:
            RunError: One of them fails.
        """
        self._tests = tests
        self._seconds: dict[str, float] = {}  # of the processor
        self._took_s: dict[str, float] = {}
        self._kills: Counter[tuple[str, str]] = Counter()  # of a test among a file's mutants, and
        self._runs: Counter[tuple[str, str]] = Counter()  # how often it was run with one
        self._reached: dict[str, set[int]] = {}  # the places that each test comes by
        for test in tests:
            self._trace(test, highest)

    def _trace(self, test: Test, highest: int) -> None:
        with tempfile.NamedTemporaryFile() as marks:
            marks.write(bytes(highest + 1))
            marks.flush()
            before, start = os.times(), time.monotonic()
            environment = {"OCTET_MUTANT_TRACE": marks.name, "OCTET_MUTANT_CPU_MS": FIRST_CPU_MS}
            if not passes(test, environment, FIRST_WAIT_S):
                raise RunError(f"{test.name} fails with no mutant acting")
            used = os.times()
            cpu = used.children_user + used.children_system - before.children_user - before.children_system
            self._seconds[test.name] = cpu
            self._took_s[test.name] = time.monotonic() - start
            found = Path(marks.name).read_bytes()
        self._reached[test.name] = {number for number, mark in enumerate(found) if mark}

    def killer(self, mutant: Mutant) -> str:
        """The test that fails with a mutant; empty if none does."""
        near = [test for test in self._tests if mutant.place in self._reached[test.name]]
        for test in sorted(near, key=lambda it: self._price(it, mutant.file)):
            key = (test.name, mutant.file)
            self._runs[key] += 1
            if not self._passes(test, mutant):
                self._kills[key] += 1
                return test.name
        return ""

    def _price(self, test: Test, file: str) -> float:
        """How long it takes a test to kill one of a file's mutants, by what it has done so far."""
        key = (test.name, file)
        return self._took_s[test.name] * (self._runs[key] + 2) / (self._kills[key] + 1)

    def _passes(self, test: Test, mutant: Mutant) -> bool:
        cpu_ms = CPU_MS + int(CPU_FACTOR * 1000 * self._seconds[test.name])
        environment = {"OCTET_MUTANT": str(mutant.number), "OCTET_MUTANT_CPU_MS": str(cpu_ms)}
        # what it may take on a machine as busy as this one
        return passes(test, environment, WAIT_S + WAIT_FACTOR * self._took_s[test.name])


def passes(test: Test, environment: Mapping[str, str], wait_s: float) -> bool:
    """Runs a test in a folder of its own, as ctest does."""
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryFile() as output:
        process = subprocess.Popen(
            test.command,
            cwd=folder,
            env={**os.environ, **environment, "TMPDIR": folder},
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        try:
            code = end(process, wait_s)
        finally:
            _stop(process)
        output.seek(0)
        text = output.read().decode(errors="replace")
    return code == 0 and not any(re.search(failing, text) for failing in test.failing)


def end(process: subprocess.Popen[bytes], wait_s: float) -> int:
    """A program's exit code; 1 if it has stood still for too long.

    One that is slow on a busy machine goes on; an endless loop uses up what it may have of the processor.
    """
    before = 0
    while (code := _code(process, wait_s)) is None:
        used = ticks_used(process.pid)
        if used == before:
            return 1
        before = used
    return code


def _code(process: subprocess.Popen[bytes], wait_s: float) -> int | None:
    """A program's exit code; None if it has not ended within that time."""
    try:
        return process.wait(wait_s)
    except subprocess.TimeoutExpired:
        return None


def ticks_used(pid: int) -> int:
    """How much of the processor a program has used so far, as the kernel counts it."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return int(fields[11]) + int(fields[12])  # utime and stime, see proc(5)


def _stop(process: subprocess.Popen[bytes]) -> None:
    """Ends what the test has left running, too."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
