"""Runs test programs with one mutant active, until a test fails."""

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


class Runner:
    """The tests of one build."""

    def __init__(self, tests: Sequence[Test], highest: int) -> None:
        """Runs each test without a mutant, to record its time and the sites it reaches.

        Args:
            tests: The tests.
            highest: The highest mutant number.

        Raises:
            VerifyError: A test fails.
        """
        self._tests = tests
        self._seconds: dict[str, float] = {}  # of processor time
        self._took_s: dict[str, float] = {}
        self._kills: Counter[tuple[str, str]] = Counter()  # mutants killed, by test and file
        self._runs: Counter[tuple[str, str]] = Counter()  # mutants tried, by test and file
        self._reached: dict[str, set[int]] = {}  # mutation sites that each test reaches
        for test in tests:
            self._trace(test, highest)

    def _trace(self, test: Test, highest: int) -> None:
        with tempfile.NamedTemporaryFile() as marks:
            marks.write(bytes(highest + 1))
            marks.flush()
            before, start = os.times(), time.monotonic()
            environment = {"OCTET_MUTANT_TRACE": marks.name, "OCTET_MUTANT_CPU_MS": FIRST_CPU_MS}
            if not passes(test, environment, FIRST_WAIT_S):
                raise VerifyError(f"{test.name} fails without a mutant")
            used = os.times()
            cpu = used.children_user + used.children_system - before.children_user - before.children_system
            self._seconds[test.name] = cpu
            self._took_s[test.name] = time.monotonic() - start
            found = Path(marks.name).read_bytes()
        self._reached[test.name] = {number for number, mark in enumerate(found) if mark}

    def killer(self, mutant: Mutant) -> str:
        """The name of a test that kills a mutant; empty if none does."""
        near = [test for test in self._tests if mutant.place in self._reached[test.name]]
        for test in sorted(near, key=lambda it: self._price(it, mutant.file)):
            key = (test.name, mutant.file)
            self._runs[key] += 1
            if not self._passes(test, mutant):
                self._kills[key] += 1
                return test.name
        return ""

    def _price(self, test: Test, file: str) -> float:
        """Estimated time for a test to kill a mutant of a file, from its history."""
        key = (test.name, file)
        return self._took_s[test.name] * (self._runs[key] + 2) / (self._kills[key] + 1)

    def _passes(self, test: Test, mutant: Mutant) -> bool:
        cpu_ms = CPU_MS + int(CPU_FACTOR * 1000 * self._seconds[test.name])
        environment = {"OCTET_MUTANT": str(mutant.number), "OCTET_MUTANT_CPU_MS": str(cpu_ms)}
        # took_s was measured on this machine, and so allows for its load
        return passes(test, environment, WAIT_S + WAIT_FACTOR * self._took_s[test.name])


def passes(test: Test, environment: Mapping[str, str], wait_s: float) -> bool:
    """Runs a test in a temporary folder; returns whether it passes, by ctest's rules."""
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
    """A program's exit code; 1 if it used no processor time for `wait_s`.

    A program that is slow on a busy machine may continue; an endless loop ends at its limit of processor time.
    """
    before = 0
    while (code := _code(process, wait_s)) is None:
        used = ticks_used(process.pid)
        if used == before:
            return 1
        before = used
    return code


def _code(process: subprocess.Popen[bytes], wait_s: float) -> int | None:
    """A program's exit code; None if it has not ended within `wait_s`."""
    try:
        return process.wait(wait_s)
    except subprocess.TimeoutExpired:
        return None


def ticks_used(pid: int) -> int:
    """Processor time that a program has used so far, in the kernel's clock ticks."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return int(fields[11]) + int(fields[12])  # utime and stime, see proc(5)


def _stop(process: subprocess.Popen[bytes]) -> None:
    """Kills a test and all that it has left running."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
