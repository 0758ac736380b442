"""A copy of the sources with all mutants compiled in, and the test programs built from it."""

import json
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tools.verify.command import output_of

FOLDERS = ("firmware", "hal", "host_sim", "tests", "tools/cmake", "tools/reference", "tools/robot_words")
SUFFIXES = {".c", ".h", ".txt", ".cmake", ".dbc", ".toml", ".map", ".py", ".inc"}
FILES = ("CMakeLists.txt", "tools/generate", "tools/pins")
RUNTIME = Path(__file__).with_name("runtime.c")
GENERATED = ("generated/robot_words.h", "generated/octet.h", "generated/build_id.h")


@dataclass(frozen=True)
class Build:
    """A build configuration.

    Attributes:
        name: Name of its folder.
        options: Options for CMake.
    """

    name: str
    options: Sequence[str] = ()


PLAIN = Build("plain")
SANITIZED = Build("sanitized", ("-DOCTET_SANITIZE=ON",))


@dataclass(frozen=True)
class Test:
    """A test as ctest would run it.

    Attributes:
        name: Name in ctest.
        command: Program and arguments.
        failing: Regular expressions; if one matches the output, the test fails.
    """

    name: str
    command: Sequence[str]
    failing: Sequence[str]


def originals(root: Path) -> dict[str, str]:
    """The text of each file that the C tests are built from, by its path from the root of the project."""
    return {path: (root / path).read_text() for path in [*FILES, *_sources(root)]}


def _sources(root: Path) -> Iterable[str]:
    for folder in FOLDERS:
        for path in (root / folder).rglob("*"):
            if path.suffix in SUFFIXES and path.is_file() and "node_modules" not in path.parts:
                yield str(path.relative_to(root))


class Tree:
    """A copy of the sources, and its builds.

    Attributes:
        folder: Folder of the copy.
    """

    def __init__(self, root: Path, folder: Path) -> None:
        """Sets the paths; copies nothing yet.

        Args:
            root: The project's folder.
            folder: Parent folder of the copy and its builds.
        """
        self.folder = folder / "source"
        self._root = root
        self._builds = folder

    def write(self, texts: Mapping[str, str]) -> None:
        """Makes the copy hold exactly these texts; files that stay the same are not written, and so not rebuilt."""
        for old in [path for path in self.folder.rglob("*") if path.is_file()]:
            if str(old.relative_to(self.folder)) not in texts:
                old.unlink()
        for path, text in texts.items():
            copied = self.folder / path
            if not copied.exists() or copied.read_text() != text:
                copied.parent.mkdir(parents=True, exist_ok=True)
                copied.write_text(text)
        (self.folder / "tools/generate").chmod(0o755)

    def configure(self, build: Build) -> None:
        """Configures a build and generates its sources.

        Raises:
            VerifyError: CMake or a generator fails.
        """
        to = self._builds / build.name
        to.mkdir(parents=True, exist_ok=True)
        runtime = to / "mutant_runtime.o"
        output_of("cc", "-O1", "-fPIC", "-c", RUNTIME, "-o", runtime)
        output_of(
            *("cmake", "-G", "Ninja", "-S", self.folder, "-B", to, "-DCMAKE_BUILD_TYPE=", "-DCMAKE_C_FLAGS=-O1 -w"),
            *(f"-DUNITY_DIR={self._root / 'build/unity'}", f"-DMONOCYPHER_DIR={self._root / 'build/monocypher'}"),
            *(f"-DCANTOOLS={self._root / '.venv/bin/cantools'}", f"-DCMAKE_C_STANDARD_LIBRARIES={runtime}"),
            *build.options,
        )
        output_of("ninja", "-C", to, *GENERATED)

    def commands(self, build: Build) -> list[Mapping[str, str]]:
        """The entries of the compilation database, one for each source."""
        entries: list[Mapping[str, str]] = json.loads(
            output_of("ninja", "-C", self._builds / build.name, "-t", "compdb")
        )
        return [entry for entry in entries if " -c " in entry["command"]]

    def tests(self, build: Build, files: Collection[str]) -> list[Test]:
        """Builds the tests that contain some files; returns those that need no CAN interface.

        Raises:
            VerifyError: They cannot be built.
        """
        to = self._builds / build.name
        targets = [target for target in self._programs(to) if self._inputs(to, target) & set(files)]
        output_of("ninja", "-C", to, *targets)
        listed = json.loads(output_of("ctest", "--test-dir", to, "-LE", "vcan", "--show-only=json-v1"))["tests"]
        built = {str(to / target) for target in targets}
        return [_test(item) for item in listed if item.get("command", ("",))[0] in built]

    def _programs(self, to: Path) -> list[str]:
        rules = (line.rpartition(": ") for line in output_of("ninja", "-C", to, "-t", "targets", "all").splitlines())
        return [path for path, _, rule in rules if path.startswith("tests/") and rule.startswith("C_EXECUTABLE")]

    def _inputs(self, to: Path, target: str) -> set[str]:
        lines = map(Path, output_of("ninja", "-C", to, "-t", "inputs", target).splitlines())
        return {str(line.relative_to(self.folder)) for line in lines if line.is_relative_to(self.folder)}


def _test(item: Mapping[str, Any]) -> Test:
    properties = {it["name"]: it["value"] for it in item["properties"]}
    return Test(item["name"], item["command"], properties.get("FAIL_REGULAR_EXPRESSION", ()))
