"""Finds the tests that a change affects: nearest in the import graph, of the same name, or mentioning the file.

What a page is made of is followed by its name, through modules and pages, to the Python that mentions them.
"""

import re
import subprocess
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

_MANY = 8
_IMPORT = re.compile(r"^\s*(?:from\s+([\w.]+)\s+import\s+(\([^)]*\)|.*)|import\s+([\w.]+))", re.MULTILINE)

_MENTION = re.compile(r"(?<![\w-])[\w-]+\.(?:js|ts|json|html|css)\b|(?<=[\"'/])\w+(?=[\"'/])")
PAGES = (".js", ".ts", ".json", ".html", ".css")

Graph = Mapping[str, set[str]]
"""The importers of each module, or the files that name each file."""


def module_of(path: str) -> str:
    """The name of the module in a Python file."""
    return path.removesuffix(".py").removesuffix("/__init__").replace("/", ".")


def importers(root: Path, paths: Iterable[str]) -> Graph:
    """The import graph of Python files below `root`."""
    known = {module_of(path): path for path in paths}
    graph: dict[str, set[str]] = defaultdict(set)
    for module, path in known.items():
        for package, names, plain in _IMPORT.findall((root / path).read_text()):
            members = (f"{package}.{name}" for name in re.findall(r"\w+", names))
            for wanted in (package or plain, *members):
                if wanted in known:
                    graph[wanted].add(module)
    return graph


def rings(graph: Graph, module: str) -> Iterable[set[str]]:
    """The importers of a module, then the importers of these, and so on; each module once."""
    seen = {module}
    ring = set(graph.get(module, ()))
    while ring := ring - seen:
        yield ring
        seen |= ring
        ring = {it for one in ring for it in graph.get(one, ())}


def is_test(path: str) -> bool:
    """Whether pytest collects the file."""
    return path.startswith("tests/") and Path(path).name.startswith("test_") and path.endswith(".py")


def mirror(path: str) -> str:
    """The folder of tests that mirrors a file's own."""
    folder = Path(path).parent.as_posix()
    return folder if folder.startswith("tests") else f"tests/{folder.removeprefix('host_sim/')}"


def by_imports(graph: Graph, changed: str) -> tuple[set[str], int]:
    """The tests nearest to a changed file in the import graph, and the number of those farther away.

    If many are equally near, only those in the mirroring test folder, if there are any.
    """
    reached = [{it.replace(".", "/") + ".py" for it in ring} for ring in rings(graph, module_of(changed))]
    tests = [found for ring in reached if (found := set(filter(is_test, ring)))]
    if not tests:
        return set(), 0
    own = {test for test in tests[0] if test.startswith(mirror(changed) + "/")}
    nearest = own if own and len(tests[0]) > _MANY else tests[0]
    return nearest, len(set().union(*tests) - nearest)


def by_name(root: Path, changed: str, tests: Iterable[str]) -> set[str]:
    """The tests named after a file in its mirroring test folder, and all tests that mention the file."""
    path = Path(changed)
    own = re.compile(rf"{re.escape(mirror(changed))}/(?:.*/)?test_(?:native_)?{re.escape(path.stem)}(?:_\w+)?\.py")
    name = rf"{re.escape(changed)}(?![\w/.-])" if path.suffix == ".py" else rf"[/\"'`]{re.escape(path.name)}[\"'`\s]"
    return {test for test in tests if own.fullmatch(test) or re.search(name, (root / test).read_text())}


def mentions(root: Path, paths: Iterable[str]) -> Graph:
    """The files that name a file of a page, by the last part of its path, or a folder."""
    graph: dict[str, set[str]] = defaultdict(set)
    for path in paths:
        for name in _MENTION.findall((root / path).read_text()):
            graph[name.replace(".js", ".ts")].add(path)  # modules import each other by what esbuild makes of them
            graph[name].add(path)
    return graph


def page_users(graph: Graph, changed: str) -> set[str]:
    """The Python files nearest to a file of a page in the graph of `mentions`."""
    found: set[str] = set()
    seen, left = {changed}, [changed]
    while left:
        path = Path(left.pop())
        folder = path.parent.name if path.suffix == ".json" else ""  # data is read from a folder
        users = graph.get(path.name, graph.get(folder, set())) - seen
        seen |= users
        found |= {it for it in users if it.endswith(".py")}
        left += [it for it in users if not it.endswith(".py")]
    return found


def c_tests(build: Path, changed: Sequence[str]) -> list[str]:
    """The C tests of a build whose programs depend on changed files.

    Args:
        build: a folder `build/NAME` that CMake and ninja have built.
        changed: paths relative to the project's root.
    """
    root = build.parent.parent
    made_of = _build_edges((build / "build.ninja").read_text())
    for target, *headers in filter(None, map(str.splitlines, _noted_deps(build).split("\n\n"))):
        made_of[target.split(": #")[0]] |= {header.strip().removeprefix(f"{build}/") for header in headers}
    wanted = {str(root / path) for path in changed} | set(changed)

    def concerned(target: str, seen: set[str]) -> bool:
        if target in wanted:
            return True
        seen.add(target)
        return any(concerned(it, seen) for it in made_of.get(target, ()) if it not in seen)

    programs = [target for target in made_of if re.search(r"/test_\w+$", target)]
    return [Path(program).name.removeprefix("test_") for program in programs if concerned(program, set())]


def _noted_deps(build: Path) -> str:
    """Ninja's list of the headers that each object includes."""
    return subprocess.check_output(("ninja", "-C", build, "-t", "deps"), text=True)


def _build_edges(text: str) -> dict[str, set[str]]:
    """The inputs of each target in a build.ninja, without order-only dependencies."""
    edges: dict[str, set[str]] = defaultdict(set)
    for targets, needs in re.findall(r"^build (.+?): \S+ ?(.*)$", text, re.MULTILINE):
        for target in _paths(targets):
            edges[target] |= set(_paths(needs.split("||")[0]))
    return edges


def _paths(text: str) -> list[str]:
    """The paths in a line of a build.ninja, where "$ " is a space within a path."""
    return [path.replace("$ ", " ") for path in re.split(r"(?<!\$) +", text.replace(" | ", " ").strip())]
