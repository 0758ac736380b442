"""The sources with their mutants, and the tests built from them."""

from collections.abc import Collection
from pathlib import Path

from tools.verify.mutants.runner import Runner
from tools.verify.mutants.sources import MUTATED, Source, options_of_sources, read_sources
from tools.verify.mutants.tree import PLAIN, Build, Tree, originals


class Project:
    """The sources and tests of the project.

    Attributes:
        files: The sources that C tests are built from.
        untested: The other sources in the mutated folders.
    """

    def __init__(self, root: Path, builds: Path, without: Collection[str] = ()) -> None:
        """Finds all sources.

        Args:
            root: The project's folder.
            builds: Folder for the builds.
            without: Names of tests to leave out.

        Raises:
            VerifyError: The build cannot be configured.
        """
        self._root = root
        self._tree = Tree(root, builds)
        self._without = without
        self._texts = originals(root)
        self._tree.write(self._texts | self._as_before())
        self._tree.configure(PLAIN)
        self._options = options_of_sources(self._tree.folder, self._tree.commands(PLAIN))
        self.files = list(self._options)
        self.untested = sorted(path for path in self._texts if _is_mutated(path) and path not in self._options)
        self._read: dict[str, Source] = {}

    def sources(self, files: Collection[str]) -> list[Source]:
        """Some of the sources, with their mutants, whose numbers do not depend on the selection.

        Raises:
            VerifyError: They cannot be read.
        """
        new = read_sources(self._root, self._options, set(files) - self._read.keys())
        self._read |= {source.file: source for source in new}
        return [self._read[file] for file in files]

    def tests(self, build: Build, files: Collection[str]) -> Runner:
        """The tests of some files, with all mutants compiled in.

        Raises:
            VerifyError: They cannot be built, or one fails without a mutant.
        """
        sources = self.sources(self.files)
        self._tree.write(self._texts | {source.file: source.schemata for source in sources})
        self._tree.configure(build)
        highest = max(mutant.number for source in sources for mutant in source.mutants)
        tests = [test for test in self._tree.tests(build, files) if test.name not in self._without]
        return Runner(tests, highest)

    def _as_before(self) -> dict[str, str]:
        """The mutated sources of the last run: those that stay the same are not rebuilt."""
        copies = {path: self._tree.folder / path for path in self._texts if _is_mutated(path)}
        return {path: it.read_text() for path, it in copies.items() if it.exists()}


def _is_mutated(path: str) -> bool:
    return path.endswith(".c") and Path(path).parts[0] in MUTATED
