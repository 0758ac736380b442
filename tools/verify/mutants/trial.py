"""Lets mutants act, and decides what became of each."""

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

TRIES = 3  # of a mutant that is listed as equivalent: a test may fail because the machine is busy


def never(_: Verdicts) -> bool:
    """Sanitizers are asked as well."""
    return False


class Trial:
    """A run over some mutants."""

    def __init__(self, project: Project, table: Sequence[Permit], tell: Callable[[str], None]) -> None:
        """Begins nothing yet.

        Args:
            project: Where they are.
            table: Which of them are equivalent.
            tell: Takes what is to be shown meanwhile.
        """
        self._project = project
        self._table = table
        self._tell = tell

    def judge(self, mutants: Sequence[Mutant], is_enough: Callable[[Verdicts], bool] = never) -> Verdicts:
        """What becomes of each.

        Args:
            mutants: All of them.
            is_enough: Whether the verdicts without sanitizers will do: these take as long again.

        Raises:
            BuildError: The tests cannot be built.
            RunError: One of them fails with no mutant acting.
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
        """Those that no test of a build fails with."""
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
        """Those that the compiler makes nothing else of; what is listed has its reason already."""
        compiler = Compiler()
        asked = [mutant for mutant in mutants if not is_covered(mutant, self._table)]
        self._tell(f"comparing the code of {len(asked)} mutants")
        sources = {source.file: source for source in self._project.sources({mutant.file for mutant in asked})}
        return set(_those(asked, lambda it: compiler.same_code(sources[it.file], it)))


def _those(mutants: Iterable[Mutant], fit: Callable[[Mutant], bool]) -> list[Mutant]:
    """Those that fit, asked side by side."""
    all_of_them = list(mutants)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return [mutant for mutant, fits in zip(all_of_them, pool.map(fit, all_of_them), strict=True) if fits]
