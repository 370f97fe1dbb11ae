"""The small changes that can be made to one module's source, each as a replaced piece of text.

Docstrings, words, annotations, decorators and ``__all__`` are left alone, and so is ``strict=`` of
``zip``: the lengths are equal unless there is a bug already.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

COMPARISONS: dict[type[ast.cmpop], tuple[str, tuple[str, ...]]] = {
    ast.Lt: ("<", ("<=", ">")),
    ast.LtE: ("<=", ("<", ">=")),
    ast.Gt: (">", (">=", "<")),
    ast.GtE: (">=", (">", "<=")),
    ast.Eq: ("==", ("!=",)),
    ast.NotEq: ("!=", ("==",)),
    ast.Is: ("is", ("is not",)),
    ast.IsNot: (r"is\s+not", ("is",)),
    ast.In: ("in", ("not in",)),
    ast.NotIn: (r"not\s+in", ("in",)),
}
ARITHMETIC: dict[type[ast.operator], tuple[str, str]] = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.Div: ("/", "*"),
    ast.FloorDiv: ("//", "/"),
    ast.Mod: ("%", "//"),
    ast.Pow: ("**", "*"),
    ast.BitAnd: ("&", "|"),
    ast.BitOr: ("|", "&"),
    ast.BitXor: ("^", "&"),
    ast.LShift: ("<<", ">>"),
    ast.RShift: (">>", "<<"),
}
_PAIRS = (
    *(("min", "max"), ("minimum", "maximum"), ("argmin", "argmax"), ("nanmin", "nanmax")),
    *(("any", "all"), ("floor", "ceil"), ("sin", "cos"), ("rstrip", "lstrip")),
    *(("startswith", "endswith"), ("removeprefix", "removesuffix")),
)
OTHER_NAME = dict(_PAIRS) | {second: first for first, second in _PAIRS} | {"link": "replace"}
"""The opposite of a function: the smallest for the largest, the first for the last."""

SYMMETRIC = {"isinstance", "issubclass", "isclose", "allclose", "hypot", "array_equal"} | {
    *("min", "max", "minimum", "maximum", "logical_and", "logical_or", "add", "multiply"),
}
"""Functions whose first two arguments may change places, or of which a swap fails at once."""


@dataclass(frozen=True, slots=True)
class Mutation:
    """One change: ``source[start:end]`` becomes ``after``.

    ``scope`` is the function it lies in, ``reach`` the lines whose running runs it, first and last:
    its statement's, or a function's whole body for a parameter's default. ``names`` are what a
    statement outside functions gives a value to, and None inside a function.
    """

    operator: str
    scope: str
    line: int
    reach: tuple[int, int]
    names: tuple[str, ...] | None
    start: int
    end: int
    before: str
    after: str

    def applied(self, source: str) -> str:
        """The source with this change made."""
        return source[: self.start] + self.after + source[self.end :]

    @property
    def words(self) -> str:
        """The change on one line, as the list of equivalent mutants names it."""
        before, after = (" ".join(text.split()) for text in (self.before, self.after))
        return f"{before} -> {after}"


def mutations(source: str) -> list[Mutation]:
    """Every mutation of a module's source, by place; `changes` says which one is a change."""
    found = _Finder(source).every(ast.parse(source))
    return sorted(found, key=lambda change: (change.start, change.end, change.after))


def changes(mutation: Mutation, source: str) -> bool:
    """Whether the mutated source is Python, and another program than the source."""
    try:
        return ast.dump(ast.parse(mutation.applied(source))) != ast.dump(ast.parse(source))
    except SyntaxError:
        return False


def code_lines(source: str) -> int:
    """The lines that hold a piece of code: no blank line, no comment, no docstring."""
    spans = [
        range(node.lineno, (node.end_lineno or node.lineno) + 1)
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    ]
    words = {line for span in spans for line in span}
    return sum(
        bool(text.strip()) and not text.lstrip().startswith("#") and number not in words
        for number, text in enumerate(source.splitlines(), 1)
    )


def _left_alone(node: ast.AST) -> bool:
    """Names for other modules, imports for the type checker, what ``zip`` checks anyway."""
    if isinstance(node, ast.Assign):
        return any(isinstance(name, ast.Name) and name.id == "__all__" for name in node.targets)
    if isinstance(node, ast.If):
        return isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"
    return isinstance(node, ast.keyword) and node.arg in {"strict", "stacklevel"}


def _droppable(node: ast.stmt) -> bool:
    """Whether a statement can be left out and every name is still known."""
    if isinstance(node, ast.Expr):
        return isinstance(node.value, ast.Call)
    if isinstance(node, ast.Assign):
        return all(isinstance(name, ast.Attribute | ast.Subscript) for name in node.targets)
    return isinstance(node, ast.AugAssign | ast.Raise | ast.Delete)


def _names_given(node: ast.stmt) -> tuple[str, ...]:
    targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
    names = [name for target in targets if target is not None for name in ast.walk(target)]
    return tuple(name.id for name in names if isinstance(name, ast.Name))


class _Finder:
    """Walks one module's tree and knows where each node lies in the text."""

    def __init__(self, source: str) -> None:
        self.source = source
        self.lines = source.splitlines(keepends=True)
        self.first = [0]
        for line in self.lines:
            self.first.append(self.first[-1] + len(line))
        self.scope: list[str] = []
        self.reach = (1, 1)
        self.names: tuple[str, ...] | None = ()

    def every(self, node: ast.AST) -> Iterator[Mutation]:
        """The mutations of a node and of all below it."""
        if _left_alone(node) or (
            isinstance(node, ast.FormattedValue) and not self.true(node.value)
        ):
            return
        before = (self.scope, self.reach, self.names)
        if isinstance(node, ast.stmt):
            self.enter(node)
        yield from self.of(node)
        for name, value in ast.iter_fields(node):
            if name in {"annotation", "returns", "decorator_list", "bases", "type_comment"}:
                continue
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    yield from self.every(child)
        self.scope, self.reach, self.names = before

    def enter(self, node: ast.stmt) -> None:
        """Note the statement that is walked now."""
        body = getattr(node, "body", None)
        last = body[0].lineno - 1 if body else node.end_lineno or node.lineno
        self.reach = (node.lineno, max(node.lineno, last))
        if isinstance(node, ast.ClassDef):
            self.scope = [*self.scope, node.name]
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            self.scope, self.names = [*self.scope, node.name], None
            self.reach = (node.body[0].lineno, node.end_lineno or node.lineno)
        elif self.names is not None:
            self.names = _names_given(node)

    def of(self, node: ast.AST) -> Iterator[Mutation]:
        """The mutations of one node."""
        if isinstance(node, ast.Compare):
            yield from self.comparisons(node)
        elif isinstance(node, ast.BinOp):
            yield from self.arithmetic(node)
        elif isinstance(node, ast.BoolOp):
            word, other = ("and", "or") if isinstance(node.op, ast.And) else ("or", "and")
            for left, right in zip(node.values, node.values[1:], strict=False):
                yield from self.between("and/or", left, right, word, other)
        elif isinstance(node, ast.UnaryOp):
            yield from self.signs(node)
        elif isinstance(node, ast.Constant):
            yield from self.constants(node)
        elif isinstance(node, ast.Subscript):
            yield from self.first_or_last(node)
        elif isinstance(node, ast.Call):
            yield from self.calls(node)
        elif isinstance(node, ast.stmt):
            yield from self.statements(node)
        yield from self.conditions(node)

    def comparisons(self, node: ast.Compare) -> Iterator[Mutation]:
        """Each comparison of a chain, at its border and turned round."""
        operands = [node.left, *node.comparators]
        for place, sign in enumerate(node.ops):
            pattern, others = COMPARISONS[type(sign)]
            for other in others:
                yield from self.between(
                    "comparison", operands[place], operands[place + 1], pattern, other, raw=True
                )

    def arithmetic(self, node: ast.BinOp) -> Iterator[Mutation]:
        """Another operator; of a matrix product the other order."""
        if isinstance(node.op, ast.MatMult):
            left, right = self.text(node.left), self.text(node.right)
            yield self.changed("order of a product", node, f"({right}) @ ({left})")
        else:
            sign, other = ARITHMETIC[type(node.op)]
            yield from self.between("arithmetic", node.left, node.right, sign, other)

    def signs(self, node: ast.UnaryOp) -> Iterator[Mutation]:
        """``not``, ``-`` or ``~`` left out."""
        length = len("not") if isinstance(node.op, ast.Not) else 1
        operator = "not" if isinstance(node.op, ast.Not) else "sign"
        if isinstance(node.op, ast.Not | ast.USub | ast.Invert):
            yield self.changed(operator, node, self.text(node)[length:].strip())

    def constants(self, node: ast.Constant) -> Iterator[Mutation]:
        """A boolean turned, a small whole number plus one, twice any other number."""
        value = node.value
        if isinstance(value, bool):
            yield self.changed("constant", node, str(not value))
        elif isinstance(value, int):
            yield self.changed("constant", node, str(value + 1 if abs(value) < 10 else 2 * value))
        elif isinstance(value, float):
            yield self.changed("constant", node, repr(2.0 * value if value else 1.0))

    def first_or_last(self, node: ast.Subscript) -> Iterator[Mutation]:
        """The first of a sequence for its last, and the other way round."""
        index = self.text(node.slice)
        if index in {"0", "-1"}:
            yield self.changed("index", node.slice, "-1" if index == "0" else "0")

    def calls(self, node: ast.Call) -> Iterator[Mutation]:
        """The opposite function; the first two arguments in the other order."""
        function = node.func
        name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
        if name in OTHER_NAME:
            end = self.at(function.end_lineno, function.end_col_offset)
            yield self.piece("function", end - len(name), end, OTHER_NAME[name])
        two = node.args[:2]
        starred = any(isinstance(argument, ast.Starred) for argument in two)
        if len(two) == 2 and not starred and name not in SYMMETRIC:
            first, second = two
            start, end = self.span(first)[0], self.span(second)[1]
            middle = self.source[self.span(first)[1] : self.span(second)[0]]
            swapped = self.text(second) + middle + self.text(first)
            yield self.piece("arguments", start, end, swapped)

    def statements(self, node: ast.stmt) -> Iterator[Mutation]:
        """A statement dropped, a loop gone on with or left, a returned pair turned round."""
        if isinstance(node, ast.Break | ast.Continue):
            other = "continue" if isinstance(node, ast.Break) else "break"
            yield self.changed("break/continue", node, other)
        elif isinstance(node, ast.Return) and isinstance(node.value, ast.Tuple):
            texts = [self.text(item) for item in node.value.elts]
            if len(texts) == 2:
                yield self.changed("returned pair", node.value, f"{texts[1]}, {texts[0]}")
        elif _droppable(node):
            yield self.changed("statement", node, "pass")

    def conditions(self, node: ast.AST) -> Iterator[Mutation]:
        """The conditions of a node negated."""
        tests = list(getattr(node, "ifs", ()))
        if isinstance(node, ast.If | ast.While | ast.IfExp):
            tests.append(node.test)
        for test in tests:
            if not (isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not)):
                yield self.changed("condition", test, f"not ({self.text(test)})")

    def between(
        self,
        operator: str,
        left: ast.expr,
        right: ast.expr,
        sign: str,
        other: str,
        raw: bool = False,
    ) -> Iterator[Mutation]:
        """The operator between two operands, replaced; ``sign`` is a pattern if ``raw``."""
        start, end = self.span(left)[1], self.span(right)[0]
        text = re.sub(r"#[^\n]*", lambda comment: " " * len(comment[0]), self.source[start:end])
        place = re.search(sign if raw else re.escape(sign), text)
        if place is None:  # inside an f-string the tree does not know the places
            return
        before, after = text[: place.start()], text[place.end() :]
        whole = self.text(left) + before + other + after + self.text(right)
        yield self.piece(operator, self.span(left)[0], self.span(right)[1], whole)

    def changed(self, operator: str, node: ast.AST, after: str) -> Mutation:
        """A node's text replaced."""
        return self.piece(operator, *self.span(node), after)

    def piece(self, operator: str, start: int, end: int, after: str) -> Mutation:
        """A piece of the text replaced, in the scope that is being walked."""
        scope = ".".join(self.scope) or "<module>"
        before = self.source[start:end]
        line = self.source.count("\n", 0, start) + 1
        return Mutation(operator, scope, line, self.reach, self.names, start, end, before, after)

    def true(self, node: ast.expr) -> bool:
        """Whether the tree knows where this part of an f-string lies: not always, before 3.12."""
        try:
            return ast.dump(ast.parse(f"({self.text(node)})", mode="eval").body) == ast.dump(node)
        except SyntaxError:
            return False

    def text(self, node: ast.AST) -> str:
        """A node's source."""
        start, end = self.span(node)
        return self.source[start:end]

    def span(self, node: ast.AST) -> tuple[int, int]:
        """Where a node begins and ends in the source."""
        known = (node.lineno, node.col_offset, node.end_lineno, node.end_col_offset)
        return self.at(*known[:2]), self.at(*known[2:])

    def at(self, line: int | None, column: int | None) -> int:
        """The place of a line and of a column in bytes, as the tree gives it."""
        assert line is not None
        assert column is not None
        text = self.lines[line - 1].encode()[:column].decode(errors="ignore")
        return self.first[line - 1] + len(text)
