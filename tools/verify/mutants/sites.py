"""Finds the mutation sites in a source's functions.

Besides the mutations of expressions (see operators), a condition is negated, a returned value becomes 0, and a
statement, `break`, `continue` or `return` is removed.
"""

from collections.abc import Sequence

from tools.verify.mutants.operators import COMPARISONS, LOGIC, Site, changes_something, site_of, span
from tools.verify.mutants.syntax import Node

GOES = "if (@HERE@) {} else @0@"
NAMED = ("CallExpr", "DeclRefExpr", "MemberExpr")


def sites_of(text: str, functions: Sequence[Node]) -> list[Site]:
    """The outermost sites of a source's functions, in order."""
    found: list[Site] = []
    for function in functions:
        _Finder(text, function.type.startswith(("_Bool", "bool"))).statement(function.children[-1], found)
    return found


class _Finder:
    """Walks through a function and adds its sites to lists."""

    def __init__(self, text: str, returns_truth: bool) -> None:
        self._text = text
        self._returns_truth = returns_truth
        self._counting: Node | None = None

    def statement(self, node: Node, sites: list[Site]) -> None:
        visit = getattr(self, f"_{node.kind.lower()}", None)
        if node.macro:
            return  # comes from a macro with arguments
        if visit is not None:
            visit(node, sites)
        elif node.kind.endswith("Stmt"):
            for child in node.children:
                self.statement(child, sites)
        elif changes_something(node):
            self._expression(node, self._removable(node, sites))

    def _removable(self, node: Node, sites: list[Site]) -> list[Site]:
        site = Site(*span(node), ["(void)0"], GOES, [span(node)])
        sites.append(site)
        return site.inner

    def _breakstmt(self, node: Node, sites: list[Site]) -> None:
        self._removable(node, sites)

    def _continuestmt(self, node: Node, sites: list[Site]) -> None:
        self._removable(node, sites)

    def _returnstmt(self, node: Node, sites: list[Site]) -> None:
        if not node.children:
            self._removable(node, sites)
            return
        value = node.children[0]
        if self._returns_truth:
            self._condition(value, sites)
        elif value.bare.kind in NAMED and value.is_number and not value.bare.names_constant:
            site = Site(*span(value), ["0"], "(@HERE@ ? 0 : (@0@))", [span(value)])
            sites.append(site)
            self._expression(value, site.inner)
        else:
            self._expression(value, sites)

    def _ifstmt(self, node: Node, sites: list[Site]) -> None:
        self._condition(node.children[0], sites)
        for child in node.children[1:]:
            self.statement(child, sites)

    def _whilestmt(self, node: Node, sites: list[Site]) -> None:
        self._ifstmt(node, sites)

    def _dostmt(self, node: Node, sites: list[Site]) -> None:
        self.statement(node.children[0], sites)
        self._condition(node.children[1], sites)

    def _forstmt(self, node: Node, sites: list[Site]) -> None:
        for part in node.children[:-1]:
            if part.kind == "DeclStmt":
                self._declstmt(part, sites)
            elif part.operator in COMPARISONS or part.operator in LOGIC:
                self._counting = part
                self._condition(part, sites)
            else:
                self._expression(part, sites)
        self.statement(node.children[-1], sites)

    def _switchstmt(self, node: Node, sites: list[Site]) -> None:
        self._expression(node.children[0], sites)
        self.statement(node.children[1], sites)

    def _casestmt(self, node: Node, sites: list[Site]) -> None:
        self.statement(node.children[-1], sites)

    def _declstmt(self, node: Node, sites: list[Site]) -> None:
        for variable in node.children:
            if variable.kind != "VarDecl" or not variable.children:
                continue
            initial: list[Site] = []
            self._expression(variable.children[-1], initial)
            if variable.json.get("storageClass") == "static" and initial:
                if "const" not in variable.type:
                    continue
                # A table can contain mutants only if it is initialised at each call: `static` is removed.
                begin = self._text.index("static", variable.begin)
                sites.append(Site(begin, begin + len("static"), [], "", []))
            sites += initial

    def _condition(self, node: Node, sites: list[Site]) -> None:
        bare = node.bare
        if bare.operator in COMPARISONS or bare.operator in LOGIC or bare.operator == "!" or bare.is_constant:
            self._expression(node, sites)
            return
        choice = f"!({self._text[node.begin : node.end]})"
        site = Site(*span(node), [choice], "(!!(@0@) ^ !!@HERE@)", [span(node)])
        sites.append(site)
        self._expression(node, site.inner)

    def _expression(self, node: Node, sites: list[Site]) -> None:
        if node.kind == "UnaryExprOrTypeTraitExpr" or node.json.get("castKind") == "NullToPointer":
            return
        if node.macro and self._text[node.end :].lstrip().startswith("("):
            return  # a macro with arguments
        if node.kind == "UnaryOperator" and node.operator == "&" and node.children[0].bare.names_constant:
            return  # the address of a constant: a mutated value has none
        site = site_of(self._text, node, self._counting)
        if site:
            sites.append(site)
        if not node.macro:
            self._within(node, site.inner if site else sites)

    def _within(self, node: Node, sites: list[Site]) -> None:
        children = node.children
        if node.kind == "ConditionalOperator":
            self._condition(children[0], sites)
            children = children[1:]
        if node.kind == "InitListExpr" and self._text[node.begin : node.end].replace(" ", "") == "{0}":
            return  # all of it is set to 0
        for child in children:
            self._expression(child, sites)
