"""What a hooks.py defines, read from its syntax tree: nothing of it is run."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from plutoc.source import Source, Span

Function = ast.FunctionDef | ast.AsyncFunctionDef
Definition = Function | ast.ClassDef | None


class Unreadable(Exception):
    """It is not Python. Carries the place, if Python told one, and what it said."""

    def __init__(self, why: str, span: Span | None) -> None:
        super().__init__(why)
        self.why, self.span = why, span


@dataclass(slots=True)
class Module:
    """The names of a module's top level."""

    source: Source
    defined: dict[str, Definition] = field(default_factory=dict)
    """By name, the last definition; None for a name that is imported or assigned."""
    imports_all: bool = False
    """There is a `from … import *`: any name may be there."""


def read(source: Source) -> Module:
    """Read a module; raise `Unreadable` where it is not Python.

    The text's lines end with `\\n`, as Python reads them.
    """
    module = Module(source)
    for statement in _all(_parsed(source).body):
        _note(module, statement)
    return module


def _parsed(source: Source) -> ast.Module:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a wrong escape: Python will say so when it flies
            return ast.parse(source.text)
    except SyntaxError as error:
        raise Unreadable(error.msg, _place(source, error)) from None
    except (RecursionError, MemoryError):
        raise Unreadable("it is nested too deep", None) from None
    except ValueError:  # before Python 3.12; since then it is a SyntaxError
        raise Unreadable("it holds a null byte, which is no text", None) from None


def _place(source: Source, error: SyntaxError) -> Span | None:
    if error.lineno is None:
        return None
    lines = source.text.count("\n") + 1
    number = min(max(error.lineno, 1), lines)
    column = min(max(error.offset or 1, 1), len(source.line(number)) + 1)
    return at(source, number, column - 1)


def at(source: Source, line: int, column: int, length: int = 1) -> Span:
    """Return a place by its line from 1 and its column from 0."""
    start = sum(len(text) + 1 for text in source.text.split("\n")[: line - 1]) + column
    return Span(start, start + length)


def _all(statements: Iterable[ast.stmt]) -> Iterator[ast.stmt]:
    """Go through a module's statements, and those that it may skip: `if`, `try`, `with`, loops."""
    for statement in statements:
        yield statement
        if isinstance(statement, Function | ast.ClassDef):
            continue
        for child in ast.iter_child_nodes(statement):
            if isinstance(child, ast.stmt):
                yield from _all([child])
            elif isinstance(child, ast.ExceptHandler | ast.match_case):
                yield from _all(child.body)


def _note(module: Module, statement: ast.stmt) -> None:
    match statement:
        case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
            module.defined[statement.name] = statement
        case ast.Import() | ast.ImportFrom():
            for alias in statement.names:
                module.imports_all |= alias.name == "*"
                module.defined[alias.asname or alias.name.partition(".")[0]] = None
        case ast.AnnAssign(value=None):
            pass  # only says what it would be
        case ast.Assign() | ast.AnnAssign():
            for node in ast.walk(statement):
                if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                    module.defined[node.id] = None


def name_span(source: Source, definition: Function | ast.ClassDef) -> Span:
    """Return the place of a definition's name."""
    line = source.line(definition.lineno)
    word = "class" if isinstance(definition, ast.ClassDef) else "def"
    before = line.find(word, _column(line, definition.col_offset)) + len(word)
    column = line.find(definition.name, before)
    if column < 0:  # the name stands in the next line, behind a backslash
        return at(source, definition.lineno, _column(line, definition.col_offset))
    return at(source, definition.lineno, column, len(definition.name))


def arg_span(source: Source, arg: ast.arg) -> Span:
    """Return the place of a parameter's name."""
    column = _column(source.line(arg.lineno), arg.col_offset)
    return at(source, arg.lineno, column, len(arg.arg))


def _column(line: str, byte: int) -> int:
    """Python counts columns in bytes of UTF-8."""
    return len(line.encode("utf-8", "surrogatepass")[:byte].decode("utf-8", "ignore"))


def yields(function: Function) -> bool:
    """Say whether calling it gives a generator, and not what it returns."""
    waiting: list[ast.AST] = list(function.body)
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Yield | ast.YieldFrom):
            return True
        if not isinstance(node, Function | ast.ClassDef | ast.Lambda):
            waiting.extend(ast.iter_child_nodes(node))
    return False
