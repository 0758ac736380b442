"""Clang's syntax trees of C sources: nodes with their offsets in the text."""

import json
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tools.verify.command import VerifyError

Json = Mapping[str, Any]

CONSTANT_PARTS = {
    "IntegerLiteral",
    "CharacterLiteral",
    "ParenExpr",
    "UnaryOperator",
    "BinaryOperator",
    "ImplicitCastExpr",
    "CStyleCastExpr",
    "UnaryExprOrTypeTraitExpr",
}
TRANSPARENT = ("ImplicitCastExpr", "ParenExpr", "CStyleCastExpr")


@dataclass
class Node:
    """A declaration, statement or expression.

    Attributes:
        kind: Clang's name for it.
        begin: Offset of its start in its file.
        end: Offset of its end, exclusive.
        macro: Whether a macro expands to it; begin and end are then those of the macro's name.
        type: Type of an expression, with typedefs resolved.
        operator: Operator of an expression that has one.
        json: Clang's whole description.
        children: Child nodes.
    """

    kind: str
    begin: int
    end: int
    macro: bool
    type: str
    operator: str
    json: Json = field(repr=False)
    children: list["Node"] = field(default_factory=list, repr=False)

    @property
    def bare(self) -> "Node":
        """The expression inside all parentheses and casts."""
        node = self
        while node.kind in TRANSPARENT and node.children and not node.macro:
            node = node.children[-1]
        return node

    def within(self) -> Iterator["Node"]:
        """This node and all of its descendants."""
        yield self
        for child in self.children:
            yield from child.within()

    @property
    def is_constant(self) -> bool:
        """Whether the compiler knows its value."""
        return all(node.kind in CONSTANT_PARTS or node.names_constant for node in self.within())

    @property
    def names_constant(self) -> bool:
        """Whether it names an enumerator or a const integer."""
        named = self.json.get("referencedDecl", {})
        kind = named.get("type", {}).get("qualType", "")
        whole = kind.startswith("const ") and not {"*", "["} & set(kind) and not kind.startswith("const struct")
        return named.get("kind") == "EnumConstantDecl" or (named.get("kind") == "VarDecl" and whole)

    @property
    def is_pointer(self) -> bool:
        """Whether its type is a pointer or an array."""
        return "*" in self.type or "[" in self.type

    @property
    def is_number(self) -> bool:
        """Whether its type is a scalar other than a pointer."""
        return not self.is_pointer and not self.type.startswith(("struct", "union", "void"))

    @property
    def is_name(self) -> bool:
        """Whether its value is one of a set of names, not a quantity."""
        return self.bare.type.startswith("enum ") or self.bare.names_constant


def functions(path: Path, options: Sequence[str]) -> list[Node]:
    """The functions that a file defines.

    Args:
        path: The source.
        options: The compiler's options: folders, definitions, the standard.

    Raises:
        VerifyError: clang cannot read it.
    """
    command = ["clang", *options, "-w", "-fsyntax-only", "-Xclang", "-ast-dump=json", str(path)]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise VerifyError(f"clang cannot read {path}:\n{result.stderr}")
    nodes = (node_of(item) for item in json.loads(result.stdout)["inner"] if item["kind"] == "FunctionDecl")
    return [node for node in nodes if node and any(child.kind == "CompoundStmt" for child in node.children)]


def node_of(item: Json) -> Node | None:
    """Converts clang's description of a node; None if the node is not in the file itself."""
    span = _span(item.get("range", {}))
    if span is None or (item["kind"].endswith("Decl") and _place(item.get("loc", {})) is None):
        return None
    kinds = item.get("type", {})
    node = Node(
        item["kind"], *span, kinds.get("desugaredQualType", kinds.get("qualType", "")), item.get("opcode", ""), item
    )
    below = (node_of(child) for child in item.get("inner", ()) if "kind" in child)
    node.children = [child for child in below if child]
    return node


def _span(source_range: Json) -> tuple[int, int, bool] | None:
    begin, end = _place(source_range.get("begin", {})), _place(source_range.get("end", {}))
    if begin is None or end is None:
        return None
    macro = "expansionLoc" in source_range["begin"] and begin == end
    return begin[0], end[1], macro


def _place(location: Json) -> tuple[int, int] | None:
    """Start and end offsets of a token; None if it is in another file."""
    here = location.get("expansionLoc", location)
    if "offset" not in here or "includedFrom" in here:
        return None
    return here["offset"], here["offset"] + here["tokLen"]
