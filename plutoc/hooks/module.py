"""What a hooks.py defines, read from its syntax tree: nothing of it is run."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass, field

from plutoc.hooks.python import at, column_of, parsed
from plutoc.source import Source, Span

Function = ast.FunctionDef | ast.AsyncFunctionDef
Definition = Function | ast.ClassDef | None


@dataclass(slots=True, kw_only=True, eq=False)
class Module:
    """The names of a module's top level."""

    source: Source
    defined: dict[str, Definition] = field(default_factory=dict)
    """By name, the last definition; None for a name that is imported or assigned."""
    imported: dict[str, str] = field(default_factory=dict)
    """What each imported name is: `typing.Any`, `.Mission` for one of the package itself."""
    imports_all: bool = False
    """There is a `from … import *`, or a `__getattr__`: any name may be there."""
    late: bool = False
    """`from __future__ import annotations`: Python does not look at them."""


def read(source: Source) -> Module:
    """Read a module; raise `Unreadable` where it is not Python.

    The text's lines end with `\\n`, as Python reads them.
    """
    module = Module(source=source)
    for statement in _all(parsed(source)):
        _note(module, statement)
    return module


def _all(module: ast.Module) -> Iterator[ast.stmt]:
    """Go through a module's statements, and those that it may skip: `if`, `try`, `with`, loops."""
    waiting: list[ast.AST] = list(reversed(module.body))
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.stmt):
            yield node
        if not isinstance(node, Function | ast.ClassDef):
            inner = (ast.stmt, ast.ExceptHandler, ast.match_case)
            children = [child for child in ast.iter_child_nodes(node) if isinstance(child, inner)]
            waiting.extend(reversed(children))


def _note(module: Module, statement: ast.stmt) -> None:
    match statement:
        case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
            module.imports_all |= statement.name == "__getattr__"
            _define(module, statement.name, statement)
        case ast.Import():
            for alias in statement.names:
                whole = alias.name if alias.asname else alias.name.partition(".")[0]
                _define(module, alias.asname or whole, None, whole)
        case ast.ImportFrom():
            start = "." * statement.level + (statement.module or "")
            start += "" if start.endswith(".") else "."
            for alias in statement.names:
                module.imports_all |= alias.name == "*"
                module.late |= (start, alias.name) == ("__future__.", "annotations")
                _define(module, alias.asname or alias.name, None, start + alias.name)
        case ast.AnnAssign(value=None):
            pass  # only says what it would be
        case _:
            for name in _bound(statement):
                _define(module, name, None)


def _define(module: Module, name: str, what: Definition, imported: str | None = None) -> None:
    module.defined[name] = what
    module.imported.pop(name, None)
    if imported is not None:
        module.imported[name] = imported


def _bound(statement: ast.stmt) -> Iterator[str]:
    """Yield the names that a statement gives a value, its inner statements left out."""
    waiting: list[ast.AST] = [statement]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        waiting.extend(
            child
            for child in ast.iter_child_nodes(node)
            if not isinstance(child, ast.stmt | ast.ExceptHandler | ast.match_case)
        )


def name_span(source: Source, definition: Function | ast.ClassDef) -> Span:
    """Return the place of a definition's name."""
    line = source.line(definition.lineno)
    word = "class" if isinstance(definition, ast.ClassDef) else "def"
    before = line.find(word, column_of(line, definition.col_offset)) + len(word)
    column = line.find(definition.name, before)
    if column < 0:  # the name stands in the next line, behind a backslash
        return at(source, definition.lineno, column_of(line, definition.col_offset))
    return at(source, definition.lineno, column, len(definition.name))


def arg_span(source: Source, arg: ast.arg) -> Span:
    """Return the place of a parameter's name."""
    return at(source, *_start(source, arg), len(arg.arg))


def node_span(source: Source, node: ast.expr | ast.Return) -> Span:
    """Return the place of an expression, or of its first line."""
    line, column = _start(source, node)
    text = source.line(line)
    end = len(text)
    if node.end_lineno == line and node.end_col_offset is not None:
        end = column_of(text, node.end_col_offset)
    return at(source, line, column, max(end - column, 1))


def _start(source: Source, node: ast.expr | ast.arg | ast.Return) -> tuple[int, int]:
    return node.lineno, column_of(source.line(node.lineno), node.col_offset)


def yields(function: Function) -> bool:
    """Return whether calling it gives a generator, and not what it returns."""
    return any(isinstance(node, ast.Yield | ast.YieldFrom) for node in own_nodes(function))


def waits(function: Function) -> ast.AST | None:
    """Return a place where it waits, if it does: `await`, `async for`, `async with`."""
    asynchronous = (ast.Await, ast.AsyncFor, ast.AsyncWith)
    return next((node for node in own_nodes(function) if isinstance(node, asynchronous)), None)


def own_nodes(function: Function) -> Iterator[ast.AST]:
    """Go through a function's body without the functions in it."""
    waiting: list[ast.AST] = list(reversed(function.body))
    while waiting:
        node = waiting.pop()
        yield node
        if not isinstance(node, Function | ast.ClassDef | ast.Lambda):
            waiting.extend(reversed(list(ast.iter_child_nodes(node))))
