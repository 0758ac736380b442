"""The mutated sources, their groups and their mutants."""

import os
import shlex
from collections.abc import Collection, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from tools.verify.mutants.schemata import Mutant, mutants_of, schemata
from tools.verify.mutants.sites import sites_of
from tools.verify.mutants.syntax import functions

MUTATED = ("firmware", "hal")
NUMBERS_EACH = 1000  # so a file that grows does not renumber the others


class Group(NamedTuple):
    """Sources that share a score.

    Attributes:
        name: Name in reports.
        bar: Share of the mutants that must be killed, percent.
        paths: Prefixes of the paths of its files.
    """

    name: str
    bar: float
    paths: Sequence[str]


GROUPS = (
    Group("store", 99.0, ("hal/flash_store/", "hal/port/posix/file_store.c")),
    Group("core", 99.0, ("firmware/",)),
    Group("codec", 99.0, ("hal/protocol/",)),
    Group("links", 99.0, ("hal/link/", "hal/can_body/", "hal/port/posix/")),
    Group("library", 99.0, ("hal/library/",)),
    Group("drivers", 97.0, ("hal/stm32/", "hal/port/cortex_m/")),
    Group("boot loader", 97.0, ("hal/boot/",)),
    Group("pins", 97.0, ("hal/pins_body/",)),
)


@dataclass(frozen=True)
class Source:
    """A source and its mutants.

    Attributes:
        file: Its path from the root of the project.
        text: The unchanged source.
        options: The compiler's options: folders, definitions, the standard.
        mutants: All of its mutants.
        schemata: The source with all mutants compiled in.
    """

    file: str
    text: str
    options: Sequence[str]
    mutants: Sequence[Mutant]
    schemata: str


def group_of(file: str) -> Group:
    """The first group with a matching path."""
    return next(group for group in GROUPS if file.startswith(tuple(group.paths)))


def options_of_sources(tree: Path, commands: Sequence[Mapping[str, str]]) -> dict[str, list[str]]:
    """The sources of firmware and HAL that tests are built from, sorted, with the compiler's options of each.

    Args:
        tree: The copy of the sources that the commands compile.
        commands: Entries of a compilation database.
    """
    return dict(sorted(dict(_options(tree, commands)).items()))


def read_sources(root: Path, options: Mapping[str, Sequence[str]], files: Collection[str]) -> list[Source]:
    """Some of the sources, with their mutants.

    Args:
        root: The project's folder.
        options: The compiler's options for all sources.
        files: The sources to read.

    Raises:
        VerifyError: Clang cannot read one of them.
    """
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        each = enumerate(options.items())
        tasks = [(root, file, words, 1 + NUMBERS_EACH * i) for i, (file, words) in each if file in files]
        return list(pool.map(_source, *zip(*tasks, strict=True))) if tasks else []


def _options(tree: Path, commands: Sequence[Mapping[str, str]]) -> Iterator[tuple[str, list[str]]]:
    for entry in commands:
        path = Path(entry["file"])
        if path.is_relative_to(tree) and path.relative_to(tree).parts[0] in MUTATED:
            words = shlex.split(entry["command"])
            kept = [i for i, word in enumerate(words) if word.startswith(("-I", "-D", "-std=", "-isystem"))]
            both = [word for i in kept for word in words[i : i + 2 if words[i] == "-isystem" else i + 1]]
            yield str(path.relative_to(tree)), both


def _source(root: Path, file: str, options: Sequence[str], first: int) -> Source:
    text = (root / file).read_text()
    sites = sites_of(text, functions(root / file, options))
    return Source(file, text, options, mutants_of(file, text, sites, first), schemata(text, sites, first))
