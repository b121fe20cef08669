"""What an annotation means, as far as a text can tell: nothing is imported to find out."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from plutoc.emit.stubs import EXPORTS
from plutoc.graph.names import near
from plutoc.hooks.module import Module
from plutoc.hooks.python import annotation

Meaning = frozenset[str] | None
"""Every type that it allows: `float`, `Mission`, `None`; None where it cannot be known."""

_TYPING = ("typing", "typing_extensions")
_NAMED = {
    "typing.Any": "object",
    **{f"typing.{name.title()}": name for name in ("list", "dict", "set", "tuple", "type")},
    "typing.FrozenSet": "frozenset",
    "typing.Text": "str",
    "typing.Sequence": "Sequence",
    "collections.abc.Sequence": "Sequence",
}
"""Types of the standard library that are known here."""

_UNION, _OPTIONAL = "typing.Union", "typing.Optional"
_NOTED, _LITERAL = "typing.Annotated", "typing.Literal"
_TYPES = frozenset(name for name, what in vars(builtins).items() if isinstance(what, type))


@dataclass(frozen=True, slots=True, kw_only=True)
class Scope:
    """What the names in an annotation can stand for."""

    module: Module
    app: str
    parameters: frozenset[str] = frozenset()
    """Of the function itself: `def find[T](…)`."""
    exports: Mapping[str, str] = field(default_factory=lambda: EXPORTS)
    """What the package offers, and where it is there."""

    @property
    def own(self) -> Mapping[str, str]:
        """What the package offers, by where it is."""
        return {f"{home}.{name}": name for name, home in self.exports.items()}

    def path(self, node: ast.expr) -> str | None:
        """Return what a name was imported as: `typing.Any`, `.Mission`, `builtins.float`."""
        parts: list[str] = []
        while isinstance(node, ast.Attribute):
            parts.append(node.attr)
            node = node.value
        if not isinstance(node, ast.Name):
            return None
        start = self.module.imported.get(node.id)
        if start is None:
            known = node.id in self.parameters or self.is_bound(node.id)
            if known or self.module.imports_all or node.id not in _TYPES:
                return None
            start = f"builtins.{node.id}"
        return self._plain(".".join([start, *reversed(parts)]))

    def _plain(self, path: str) -> str:
        """Return a path with one spelling for each thing."""
        first, _, rest = path.partition(".")
        if first == self.app:
            return f".{rest}"
        return f"{_TYPING[0]}.{rest}" if first in _TYPING else path

    def is_bound(self, name: str) -> bool:
        """Return whether the module gives the name a value."""
        return name in self.module.defined

    def is_known(self, name: str) -> bool:
        """Return whether Python would find the name, or may."""
        found = name in self.parameters or self.is_bound(name) or name in vars(builtins)
        return found or self.module.imports_all


def meaning(node: ast.expr, scope: Scope) -> Meaning:
    """Return what an annotation allows."""
    match node:
        case ast.Constant(value=None):
            return frozenset({"None"})
        case ast.Constant(value=str() as text):
            inner = annotation(text)
            return None if inner is None else meaning(inner, scope)
        case ast.BinOp(op=ast.BitOr()):
            return _either([meaning(side, scope) for side in (node.left, node.right)])
        case ast.Subscript():
            return _of_subscript(node, scope)
        case ast.Name() | ast.Attribute():
            return _of_path(scope.path(node), scope)
    return None


def _of_path(path: str | None, scope: Scope) -> Meaning:
    if path is None:
        return None
    first, _, rest = path.partition(".")
    if first == "builtins":
        return frozenset({rest}) if rest in _TYPES else None
    name = rest if not first and rest in scope.exports else scope.own.get(path) or _NAMED.get(path)
    return None if name is None else frozenset({name})


def _of_subscript(node: ast.Subscript, scope: Scope) -> Meaning:
    path = scope.path(node.value)
    inner = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
    if path == _OPTIONAL:
        return _either([meaning(node.slice, scope), frozenset({"None"})])
    if path == _UNION:
        return _either([meaning(one, scope) for one in inner])
    if path == _NOTED and inner:
        return meaning(inner[0], scope)
    return _of_path(path, scope)


def _either(sides: list[Meaning]) -> Meaning:
    known = [side for side in sides if side is not None]
    return frozenset().union(*known) if len(known) == len(sides) else None


@dataclass(frozen=True, slots=True, kw_only=True)
class Unknown:
    """A name in an annotation that nothing has."""

    name: str
    place: ast.expr
    options: tuple[str, ...]
    """What may have been meant."""
    exported: bool
    """The package has it, and the file does not import it."""


def unknown_names(node: ast.expr, scope: Scope) -> Iterator[Unknown]:
    """Yield the names in an annotation that Python would not find."""
    for one, place, quoted in _names(node, scope):
        if isinstance(one, ast.Name) and not scope.is_known(one.id):
            exported = one.id in scope.exports
            if not exported or not (quoted or scope.module.late):
                options = (*scope.exports, *scope.module.defined, *sorted(_TYPES))
                yield Unknown(name=one.id, place=place, options=options, exported=exported)
            continue
        name = (scope.path(one) or "").removeprefix(".")
        if name in (scope.path(one), *scope.exports) or not name.isidentifier() or name.islower():
            continue
        if near(name, scope.exports):  # else it may be of a module that the developer has written
            yield Unknown(name=name, place=place, options=tuple(scope.exports), exported=False)


def _names(node: ast.expr, scope: Scope) -> Iterator[tuple[ast.expr, ast.expr, bool]]:
    """Yield the names in an annotation, the place to show, and whether it stands in quotes."""
    waiting: list[tuple[ast.expr, ast.expr | None]] = [(node, None)]
    while waiting:
        one, within = waiting.pop()
        match one:
            case ast.Name() | ast.Attribute():
                yield one, within or one, within is not None
            case ast.Constant(value=str() as text):
                inner = annotation(text)
                if inner is not None and within is None:
                    waiting.append((inner, one))
            case ast.Subscript(value=value, slice=inside):
                path = scope.path(value)
                parts = inside.elts if isinstance(inside, ast.Tuple) else [inside]
                parts = [] if path == _LITERAL else parts[:1] if path == _NOTED else parts
                waiting.extend((part, within) for part in reversed(parts))
                waiting.append((value, within))
            case ast.BinOp(left=left, right=right):
                waiting.extend([(right, within), (left, within)])
            case ast.List(elts=parts) | ast.Tuple(elts=parts):
                waiting.extend((part, within) for part in reversed(parts))
