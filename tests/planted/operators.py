"""Proposes bugs: one small mistake at each place of a file where somebody could have made it.

Each is a change of behaviour in the eyes of the parser; whether anybody could tell is for the tests to say.
Left out are types, docstrings, sentences of errors, and what only a type checker reads.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from tests.planted.bug import Bug

_COMPARED: dict[type[ast.cmpop], tuple[str, str]] = {
    ast.Lt: ("<", "<="),
    ast.LtE: ("<=", "<"),
    ast.Gt: (">", ">="),
    ast.GtE: (">=", ">"),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
    ast.Is: ("is", "is not"),
    ast.IsNot: ("is not", "is"),
    ast.In: ("in", "not in"),
    ast.NotIn: ("not in", "in"),
}
_COMPUTED: dict[type[ast.operator], tuple[str, str]] = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.Div: ("/", "*"),
}
_CALLED = {"min": "max", "max": "min", "any": "all", "all": "any"}
_TOLERANCE = 1e-3
"""Smaller numbers are there for rounding: twice as much of it is nothing that anybody could see."""
_DECLARES = {"strict", "init", "repr"}
"""Arguments that assert something, or say how a class may be made and shown: nothing that happens."""
_JUMPS = (ast.Return, ast.Continue, ast.Break, ast.Raise)


class Proposals(ast.NodeVisitor):
    """Collects the bugs of one file."""

    def __init__(self, file: str, text: str) -> None:
        self._file = file
        self._text = text
        lines = text.splitlines(keepends=True)
        self._starts = [0]
        for line in lines:
            self._starts.append(self._starts[-1] + len(line))
        self._lines = lines
        self.bugs: list[Bug] = []

    def _place(self, line: int, column: int) -> int:
        """Return a place in characters: the parser counts columns in bytes."""
        before = self._lines[line - 1].encode()[:column].decode()
        return self._starts[line - 1] + len(before)

    def _span(self, node: ast.expr | ast.stmt) -> tuple[int, int]:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        start = self._place(node.lineno, node.col_offset)
        return start, self._place(node.end_lineno, node.end_col_offset)

    def _propose(self, start: int, end: int, after: str, what: str) -> None:
        before = self._text[start:end]
        self.bugs.append(Bug(file=self._file, start=start, before=before, after=after, what=what))

    def _between(self, left: ast.expr, right: ast.expr, word: str, other: str, what: str) -> None:
        """Replace an operator, which stands between two operands."""
        start, end = self._span(left)[1], self._span(right)[0]
        at = self._text.find(word, start, end)
        if at >= 0:
            self._propose(at, at + len(word), other, what)

    # What is no behaviour

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        """Look at the body and the defaults, not at types and decorators."""
        for default in (*node.args.defaults, *node.args.kw_defaults):
            if default is not None:
                self.visit(default)
        self._body(node.body)

    def visit_AsyncFunctionDef(self, node: ast.AsyncFunctionDef) -> None:
        """Look at the body, as in a function that does not wait."""
        self._body(node.body)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        """Look at the value alone."""
        if node.value is not None:
            self.visit(node.value)

    def visit_Raise(self, node: ast.Raise) -> None:
        """Leave the sentence of an error alone."""

    def visit_Assert(self, node: ast.Assert) -> None:
        """Leave it alone: it says what is known already."""

    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:
        """Leave sentences alone."""

    # What is

    def visit_Compare(self, node: ast.Compare) -> None:
        """A boundary that is off by one, or a test that means the opposite."""
        operands = [node.left, *node.comparators]
        for left, op, right in zip(operands, node.ops, node.comparators, strict=False):
            word, other = _COMPARED[type(op)]
            self._between(left, right, word, other, "comparison")
        self.generic_visit(node)

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        """`and` for `or`."""
        word, other = ("and", "or") if isinstance(node.op, ast.And) else ("or", "and")
        self._between(node.values[0], node.values[1], word, other, "and, or")
        self.generic_visit(node)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        """A `not` that is missing."""
        if isinstance(node.op, ast.Not):
            start, end = self._span(node)
            inner = self._text[start + len("not") : end].lstrip()
            self._propose(start, end, inner, "not")
        self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        """The wrong arithmetic."""
        if type(node.op) in _COMPUTED and not _is_text(node.left) and not _is_text(node.right):
            word, other = _COMPUTED[type(node.op)]
            self._between(node.left, node.right, word, other, "arithmetic")
        self.generic_visit(node)

    def visit_Call(self, node: ast.Call) -> None:
        """The least for the largest, any for all."""
        if isinstance(node.func, ast.Name) and node.func.id in _CALLED:
            start, end = self._span(node.func)
            self._propose(start, end, _CALLED[node.func.id], "min, max, any, all")
        for argument in node.args:
            self.visit(argument)
        for keyword in node.keywords:
            if keyword.arg not in _DECLARES:
                self.visit(keyword.value)

    def visit_Constant(self, node: ast.Constant) -> None:
        """Another number, or the other truth."""
        start, end = self._span(node)
        if isinstance(node.value, bool):
            self._propose(start, end, str(not node.value), "truth")
        elif isinstance(node.value, int | float) and not 0 < abs(node.value) < _TOLERANCE:
            other = node.value * 2 if node.value else 1
            self._propose(start, end, repr(other), "number")

    def visit_If(self, node: ast.If) -> None:
        """A guard that is missing, or that means the opposite."""
        if ast.unparse(node.test) == "TYPE_CHECKING":
            return
        start, end = self._span(node.test)
        if isinstance(node.body[-1], _JUMPS) and not node.orelse:
            self._propose(start, end, "False", "guard")
        elif not isinstance(node.test, ast.Compare | ast.UnaryOp | ast.NamedExpr):
            self._propose(start, end, f"not ({self._text[start:end]})", "condition")
        self.visit(node.test)
        self._body(node.body)
        self._body(node.orelse)

    def visit_ClassDef(self, node: ast.ClassDef) -> None:
        """Look at the methods."""
        self._body(node.body)

    def _body(self, body: list[ast.stmt]) -> None:
        """Statements that are missing: calls for their effect, and attributes that are set."""
        for statement in body:
            match statement:
                case ast.Expr(value=ast.Constant()):
                    continue  # a docstring
                case ast.Expr(value=ast.Call() | ast.Await()):
                    self._propose(*self._span(statement), "pass", "statement")
                case ast.Assign(targets=[ast.Attribute(attr=name)]) if not name.startswith("__"):
                    self._propose(*self._span(statement), "pass", "statement")
                case ast.AugAssign():
                    self._propose(*self._span(statement), "pass", "statement")
            self.visit(statement)


def _is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.JoinedStr | ast.Tuple | ast.List) or (
        isinstance(node, ast.Constant) and isinstance(node.value, str)
    )


def proposals(file: str, text: str) -> Iterator[Bug]:
    """Yield the bugs of a file, in its order."""
    found = Proposals(file, text)
    for statement in ast.parse(text).body:
        if not isinstance(statement, ast.Import | ast.ImportFrom):
            found.visit(statement)
    yield from sorted(found.bugs, key=lambda bug: (bug.start, bug.after))
