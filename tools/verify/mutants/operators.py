"""Mutation operators for expressions.

A comparison is replaced by its neighbours or by a constant; `&&` and `||` are swapped or lose a side; arithmetic,
shift, bit and sign operators are replaced; a number or a named constant is incremented; `!` is removed.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

from tools.verify.mutants.syntax import Node

COMPARISONS = {
    "<": ("<=", "!=", "0"),
    ">": (">=", "!=", "0"),
    "<=": ("<", "==", "1"),
    ">=": (">", "==", "1"),
    "==": ("<=", ">=", "0"),
    "!=": ("<", ">", "1"),
}
OTHER = {"+": "-", "-": "+", "*": "+", "/": "*", "%": "/", "&": "|", "|": "&", "^": "|", "<<": ">>", ">>": "<<"}
LEVELS = ({"*", "/"}, {"%", "/"}, {"+", "-"}, {"<<", ">>"}, {"<", ">", "<=", ">="}, {"==", "!="})
LOGIC = ("&&", "||")
CHANGING = ("CallExpr", "CompoundAssignOperator")
ATOMS = ("DeclRefExpr", "MemberExpr", "CallExpr", "ArraySubscriptExpr", "IntegerLiteral", "CharacterLiteral")


@dataclass
class Site:
    """A place that can be mutated.

    Attributes:
        begin: Offset of its start in the source.
        end: Offset of its end, exclusive.
        choices: The replacement text of each mutant.
        template: The text with all mutants compiled in: @HERE@ is the number of the active mutant, from 1, or 0; @0@,
            @1@ are the parts.
        parts: Start and end offsets of the parts.
        inner: The sites inside this one.
    """

    begin: int
    end: int
    choices: list[str]
    template: str
    parts: list[tuple[int, int]]
    inner: list["Site"] = field(default_factory=list)


def span(node: Node) -> tuple[int, int]:
    """Start and end offsets of a node."""
    return node.begin, node.end


def changes_something(node: Node) -> bool:
    """Whether an expression may have side effects."""
    return any(part.kind in CHANGING or part.operator in ("=", "++", "--") for part in node.within())


def site_of(text: str, node: Node, counting: Node | None) -> Site | None:
    """The site of an expression, without inner sites; None if it has no mutants.

    Args:
        text: The source.
        node: The expression.
        counting: The condition of the innermost loop that counts up by one: there `!=` is the same as `<`.
    """
    operators = _Operators(text, counting)
    if node.macro or node.kind in ("IntegerLiteral", "CharacterLiteral") or node.names_constant:
        return operators.constant(node)
    if node.kind == "BinaryOperator":
        return operators.logic(node) if node.operator in LOGIC else operators.binary(node)
    if node.kind == "CompoundAssignOperator":
        return operators.change(node)
    if node.kind == "UnaryOperator":
        return operators.step(node) if node.operator in ("++", "--") else operators.sign(node)
    return None


class _Operators:
    """Makes the sites of expressions."""

    def __init__(self, text: str, counting: Node | None) -> None:
        self._text = text
        self._counting = counting

    def constant(self, node: Node) -> Site | None:
        source = self._source(node)
        if not node.is_constant or node.is_pointer:
            return None
        choice = {"true": "false", "false": "true"}.get(source, f"({source} + 1)")
        return Site(*span(node), [choice], f"({{ @HERE@ ? {choice} : {source}; }})", [])

    def binary(self, node: Node) -> Site | None:
        operators = self._replacements(node)
        if not operators:
            return None
        picks = [f"m_ == {i} ? {new if new in '01' else f'l_ {new} r_'} : " for i, new in enumerate(operators, 1)]
        body = f"{''.join(picks)}l_ {node.operator} r_"
        template = f"({{ unsigned m_ = @HERE@; __auto_type l_ = (@0@); __auto_type r_ = (@1@); {body}; }})"
        return Site(*span(node), [self._with(node, new) for new in operators], template, [*map(span, node.children)])

    def _replacements(self, node: Node) -> Sequence[str]:
        left, right = node.children
        if node.operator in ("==", "!=") and (left.is_pointer or left.is_name or right.is_name):
            return ("0", "1")
        if node.operator in COMPARISONS:
            same = "!=" if node is self._counting else ""
            return [new for new in COMPARISONS[node.operator] if new != same]
        return [OTHER[node.operator]] if node.operator in OTHER and not right.is_pointer else []

    def _with(self, node: Node, new: str) -> str:
        """A binary expression with another operator, or as a constant."""
        left, right = node.children
        if new in "01":
            return f"(({self._source(node)}), {new})" if changes_something(node) else new
        if any({new, node.operator} <= level for level in LEVELS):
            return f"{self._source(left)} {new} {self._source(right)}"
        return self._whole(node, f"{self._beside(left)} {new} {self._beside(right)}")

    def logic(self, node: Node) -> Site:
        left, right = map(self._beside, node.children)
        other = "||" if node.operator == "&&" else "&&"
        go, stop = ("l_", "0") if node.operator == "&&" else ("!l_", "1")
        template = (
            f"({{ unsigned m_ = @HERE@; int l_ = !!(@0@);"
            f" (m_ == 1 ? !({go}) : m_ == 2 ? 0 : m_ == 3 ? 1 : ({go})) ? !!(@1@)"
            f" : (m_ == 1 ? !{stop} : m_ == 2 ? l_ : {stop}); }})"
        )
        alone = f"({left}, {right})" if changes_something(node.children[0]) else right
        choices = [self._whole(node, f"{left} {other} {right}"), left, alone]
        return Site(*span(node), choices, template, [*map(span, node.children)])

    def change(self, node: Node) -> Site | None:
        target, value = node.children
        plain = OTHER[node.operator[:-1]]
        if target.is_pointer and plain not in "+-":
            return None
        both = f"m_ ? (@0@ {plain}= r_) : (@0@ {node.operator} r_)"
        template = f"({{ unsigned m_ = @HERE@; __auto_type r_ = (@1@); {both}; }})"
        choice = f"{self._source(target)} {plain}= {self._source(value)}"
        return Site(*span(node), [choice], template, [span(target), span(value)])

    def step(self, node: Node) -> Site:
        operand = node.children[0]
        new = "--" if node.operator == "++" else "++"
        form = "{operand}{operator}" if node.json["isPostfix"] else "{operator}{operand}"
        acting, as_it_is = (form.format(operand="@0@", operator=operator) for operator in (new, node.operator))
        choice = form.format(operand=self._source(operand), operator=new)
        return Site(*span(node), [choice], f"(@HERE@ ? {acting} : {as_it_is})", [span(operand)])

    def sign(self, node: Node) -> Site | None:
        operand = node.children[0]
        if node.operator in ("-", "~"):
            template = f"({{ unsigned m_ = @HERE@; __auto_type l_ = (@0@); m_ ? l_ : {node.operator}l_; }})"
            return Site(*span(node), [self._source(operand)], template, [span(operand)])
        if node.operator == "!":
            return Site(*span(node), [f"!!{self._source(operand)}"], "(!(@0@) ^ !!@HERE@)", [span(operand)])
        return None

    def _source(self, node: Node) -> str:
        return self._text[node.begin : node.end]

    def _beside(self, node: Node) -> str:
        """An operand, in parentheses if an operator beside it needs them."""
        source = self._source(node)
        return source if node.bare.kind in ATOMS and node.kind != "CStyleCastExpr" else f"({source})"

    def _whole(self, node: Node, text: str) -> str:
        """The replacement of a whole expression, in parentheses unless the source has them there."""
        enclosed = self._text[node.begin - 1] == "(" and self._text[node.end] == ")"
        return text if enclosed else f"({text})"
