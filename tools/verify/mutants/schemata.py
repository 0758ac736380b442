"""Mutant schemata: one version of a source that contains all of its mutants, of which one at a time is active."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from tools.verify.mutants.operators import Site

HEAD = "unsigned mutant_at(unsigned first, unsigned count);\n#line 1\n"


@dataclass(frozen=True)
class Mutant:
    """A change to a source.

    Attributes:
        file: File, relative to the project's root.
        line: Line, from 1.
        before: The lines that change, joined to one.
        after: The same after the change.
        number: Unique among all mutants that are compiled together.
        place: Number of the first mutant of the same site.
        begin: Offset of the change in the source.
        end: Offset of its end, exclusive.
        text: The replacement text.
    """

    file: str
    line: int
    before: str
    after: str
    number: int
    place: int
    begin: int
    end: int
    text: str

    @property
    def what(self) -> str:
        """Its description, as tables name it."""
        return f"{self.before} -> {self.after}"

    def apply(self, source: str) -> str:
        """The whole source with this change alone."""
        return source[: self.begin] + self.text + source[self.end :]

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.what}"


def mutants_of(file: str, text: str, sites: Sequence[Site], first: int) -> list[Mutant]:
    """All mutants of a source, numbered from `first` in the order in which `schemata` numbers them."""
    found: list[Mutant] = []
    for site in _walk(sites):
        place = first + len(found)
        found += [_mutant(file, text, site, place, i) for i in range(len(site.choices))]
    return found


def schemata(text: str, sites: Sequence[Site], first: int) -> str:
    """The source with all of its mutants compiled in."""
    numbers: dict[int, int] = {}
    for site in _walk(sites):
        numbers[id(site)] = first
        first += len(site.choices)
    return HEAD + _rendered(text, 0, len(text), sites, numbers)


def _walk(sites: Sequence[Site]) -> Iterator[Site]:
    for site in sites:
        yield site
        yield from _walk(site.inner)


def _rendered(text: str, begin: int, end: int, sites: Sequence[Site], numbers: dict[int, int]) -> str:
    """A range of the source, with the mutants of its sites compiled in."""
    pieces = []
    at = begin
    for site in sorted((it for it in sites if begin <= it.begin and it.end <= end), key=lambda it: it.begin):
        pieces += [text[at : site.begin], _site(text, site, numbers)]
        at = site.end
    return "".join(pieces) + text[at:end]


def _site(text: str, site: Site, numbers: dict[int, int]) -> str:
    here = f"mutant_at({numbers[id(site)]}u, {len(site.choices)}u)"
    values = {str(i): _rendered(text, *part, site.inner, numbers) for i, part in enumerate(site.parts)}
    return re.sub(r"@(\w+)@", lambda found: here if found[1] == "HERE" else values[found[1]], site.template)


def _mutant(file: str, text: str, site: Site, place: int, index: int) -> Mutant:
    begin = text.rfind("\n", 0, site.begin) + 1
    end = text.find("\n", site.end)
    choice = site.choices[index]
    before, after = text[begin:end], text[begin : site.begin] + choice + text[site.end : end]
    line = text.count("\n", 0, site.begin) + 1
    return Mutant(file, line, _in_one(before), _in_one(after), place + index, place, site.begin, site.end, choice)


def _in_one(lines: str) -> str:
    return " ".join(lines.split())
