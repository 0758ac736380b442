"""The worst-case stack of an image, from the call graphs that gcc writes with -fcallgraph-info."""

import re
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from tools.verify.command import VerifyError

LIBRARY = 32
"""Bytes assumed for each function of the compiler's library, an upper bound; none of these calls another function."""

_NODE = re.compile(r'^node: \{ title: "([^"]+)" label: "[^"]*\\n(\d+) bytes \(([a-z, ]+)\)', re.MULTILINE)
_EDGE = re.compile(r'^edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"', re.MULTILINE)


@dataclass
class CallGraph:
    """A call graph with the stack frame of each function.

    Attributes:
        frames: Bytes of stack of each function, by name; static functions have their file's path as a prefix.
        calls: The functions that each function calls.
    """

    frames: dict[str, int] = field(default_factory=dict)
    calls: defaultdict[str, set[str]] = field(default_factory=lambda: defaultdict(set))

    def add(self, text: str) -> None:
        """Adds the text of a .ci file that the compiler wrote.

        Raises:
            VerifyError: The stack frame of a function is not constant.
        """
        for name, size, kind in _NODE.findall(text):
            if kind != "static":
                raise VerifyError(f"the stack of {name} is {kind}")
            self.frames[name] = int(size)
        for caller, callee in _EDGE.findall(text):
            self.calls[caller].add(callee)

    def worst(self, function: str, above: tuple[str, ...] = ()) -> tuple[int, list[str]]:
        """The deepest call chain from a function: its bytes of stack, and its functions.

        Raises:
            VerifyError: There is recursion, or a call through a pointer.
        """
        if function in above:
            raise VerifyError(f"{function} calls itself, through {' '.join(above)}")
        if function == "__indirect_call":
            raise VerifyError(f"{above[-1]} calls through a pointer")
        deepest, way = 0, list[str]()
        for callee in sorted(self.calls[function]):
            depth, further = self.worst(callee, (*above, function))
            if depth > deepest:
                deepest, way = depth, further
        return self.frames.get(function, LIBRARY) + deepest, [function, *way]


def read_graph(build: Path, image: str) -> CallGraph:
    """The call graph of an image, from link-time optimization and from files compiled without it.

    Args:
        build: The build folder.
        image: The image's name.

    Raises:
        VerifyError: It is missing, or the stack frame of a function is not constant.
    """
    graph = CallGraph()
    linked = sorted(build.glob(f"{image}.elf.ltrans*.ci"))
    if not linked:
        raise VerifyError(f"no call graph of {image} in {build}")
    for path in (*linked, *sorted(build.glob("*/**/*.ci"))):
        graph.add(path.read_text())
    return graph


def worst_stack(graph: CallGraph, roots: Iterable[str]) -> tuple[int, list[str]]:
    """The deepest call chain from any of the roots, each of which begins with an empty stack."""
    return max((graph.worst(root) for root in roots), key=lambda found: found[0])
