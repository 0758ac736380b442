"""Tries mutants and gives a verdict on each."""

import os
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import groupby

from tools.verify.exceptions import Permit, is_covered
from tools.verify.mutants.equivalent import Compiler
from tools.verify.mutants.project import Project
from tools.verify.mutants.runner import Runner
from tools.verify.mutants.schemata import Mutant
from tools.verify.mutants.tree import PLAIN, SANITIZED, Build
from tools.verify.mutants.verdicts import Verdict

Verdicts = list[tuple[Mutant, Verdict]]

TRIES = 3  # for a mutant listed as equivalent, since a test may fail because the machine is busy


def never(_: Verdicts) -> bool:
    """Always runs the sanitizer build, too."""
    return False


class Trial:
    """A trial of mutants."""

    def __init__(self, project: Project, table: Sequence[Permit], tell: Callable[[str], None]) -> None:
        """Starts nothing yet.

        Args:
            project: The sources and tests.
            table: The equivalent mutants.
            tell: Called with each progress message.
        """
        self._project = project
        self._table = table
        self._tell = tell

    def judge(self, mutants: Sequence[Mutant], is_enough: Callable[[Verdicts], bool] = never) -> Verdicts:
        """The verdict on each mutant.

        Args:
            mutants: The mutants to try.
            is_enough: Whether the verdicts without sanitizers suffice; the sanitizer build doubles the time.

        Raises:
            VerifyError: The tests cannot be built, or one fails without a mutant.
        """
        left = self._survivors(PLAIN, mutants)
        same = self._of_same_code(left)
        alive = [mutant for mutant in left if mutant not in same]
        verdicts = self._verdicts(mutants, same, alive)
        if is_enough(verdicts):
            return verdicts
        return self._verdicts(mutants, same, self._survivors(SANITIZED, alive))

    def _verdicts(self, mutants: Sequence[Mutant], same: Iterable[Mutant], alive: Iterable[Mutant]) -> Verdicts:
        verdicts = dict.fromkeys(mutants, Verdict.KILLED) | dict.fromkeys(same, Verdict.SAME_CODE)
        verdicts |= {it: Verdict.LISTED if is_covered(it, self._table) else Verdict.ALIVE for it in alive}
        return list(verdicts.items())

    def _survivors(self, build: Build, mutants: Sequence[Mutant]) -> list[Mutant]:
        """The mutants that no test of a build kills."""
        if not mutants:
            return []
        self._tell(f"building, {build.name}")
        tests = self._project.tests(build, {mutant.file for mutant in mutants})
        left: list[Mutant] = []
        for file, group in groupby(sorted(mutants, key=lambda it: it.file), lambda it: it.file):
            of_file = list(group)
            alive = _those(of_file, lambda it: self._survives(tests, it))
            self._tell(f"{file}: {len(of_file)} mutants, {len(alive)} alive, {build.name}")
            left += alive
        return left

    def _survives(self, tests: Runner, mutant: Mutant) -> bool:
        tries = TRIES if is_covered(mutant, self._table) else 1
        return any(not tests.killer(mutant) for _ in range(tries))

    def _of_same_code(self, mutants: Sequence[Mutant]) -> set[Mutant]:
        """The mutants that compile to the same code; those listed as equivalent are not compared."""
        compiler = Compiler()
        asked = [mutant for mutant in mutants if not is_covered(mutant, self._table)]
        self._tell(f"comparing the code of {len(asked)} mutants")
        sources = {source.file: source for source in self._project.sources({mutant.file for mutant in asked})}
        return set(_those(asked, lambda it: compiler.same_code(sources[it.file], it)))


def _those(mutants: Iterable[Mutant], fit: Callable[[Mutant], bool]) -> list[Mutant]:
    """The mutants that satisfy a condition, checked in parallel."""
    all_of_them = list(mutants)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return [mutant for mutant, fits in zip(all_of_them, pool.map(fit, all_of_them), strict=True) if fits]
