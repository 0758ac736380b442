"""The sources with their mutants, and the tests built from them."""

from collections.abc import Collection
from pathlib import Path

from tools.mutants.runner import Runner
from tools.mutants.sources import MUTATED, read_sources
from tools.mutants.tree import PLAIN, Build, Tree, originals


class Project:
    """What is mutated.

    Attributes:
        sources: All that some C test is built from, by their files.
        untested: The other sources of the folders that are mutated.
    """

    def __init__(self, root: Path, builds: Path, without: Collection[str] = ()) -> None:
        """Reads all sources.

        Args:
            root: Of the project.
            builds: A folder for what is built.
            without: Names of tests that are left out.

        Raises:
            BuildError: They cannot be built.
            SourceError: They cannot be read.
        """
        self._tree = Tree(root, builds)
        self._without = without
        self._texts = originals(root)
        self._tree.write(self._texts | self._as_before())
        self._tree.configure(PLAIN)
        found = read_sources(root, self._tree.folder, self._tree.commands(PLAIN))
        self.sources = {source.file: source for source in found}
        self.untested = sorted(path for path in self._texts if _is_mutated(path) and path not in self.sources)

    def tests(self, build: Build, files: Collection[str]) -> Runner:
        """The tests of some files, with all mutants compiled in.

        Raises:
            BuildError: They cannot be built.
            RunError: One of them fails with no mutant acting.
        """
        self._tree.write(self._texts | {file: source.schemata for file, source in self.sources.items()})
        self._tree.configure(build)
        highest = max(mutant.number for source in self.sources.values() for mutant in source.mutants)
        tests = [test for test in self._tree.tests(build, files) if test.name not in self._without]
        return Runner(tests, highest)

    def _as_before(self) -> dict[str, str]:
        """The mutated sources of the last time: one that becomes the same again is not built again."""
        copies = {path: self._tree.folder / path for path in self._texts if _is_mutated(path)}
        return {path: it.read_text() for path, it in copies.items() if it.exists()}


def _is_mutated(path: str) -> bool:
    return path.endswith(".c") and Path(path).parts[0] in MUTATED
