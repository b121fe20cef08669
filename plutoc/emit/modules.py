"""The installed modules that are carried along: their text, and what they import."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import plutoc_runtime

RUNTIME = plutoc_runtime.__name__


class EmbedError(Exception):
    """An installed module cannot be carried along. The message says where and what to change."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Module:
    """An installed module: its text, byte for byte, read as UTF-8."""

    name: str
    file: str
    text: str
    is_package: bool

    @property
    def package(self) -> str:
        """The package that its relative imports start from."""
        return self.name if self.is_package else self.name.rpartition(".")[0]

    def refuse(self, line: int, problem: str) -> EmbedError:
        """Return the error for something in a line of it."""
        return EmbedError(f"{self.file}:{line}: {problem}")


class ImportFrom(NamedTuple):
    """`from target import names`, the target spelled out in full."""

    target: str
    names: tuple[str, ...]
    line: int
    column: int
    """In bytes of the line."""
    written: str
    """The target as the line has it, dots included."""


@cache
def load(name: str) -> Module | None:
    """Return an installed module's text; None where there is no such module."""
    try:
        spec = find_spec(name)
    except ModuleNotFoundError:  # what should be a package on the way there is none
        return None
    if spec is None or spec.origin is None or not spec.origin.endswith(".py"):
        return None
    return Module(
        name=name,
        file=spec.origin,
        text=Path(spec.origin).read_bytes().decode(),
        is_package=spec.submodule_search_locations is not None,
    )


def is_within(name: str, package: str) -> bool:
    """Return whether a module is a package, or in it."""
    return name == package or name.startswith(f"{package}.")


def is_standard(name: str) -> bool:
    """Return whether a module is Python's own."""
    return name.partition(".")[0] in sys.stdlib_module_names


@cache
def imports_from(module: Module) -> tuple[ImportFrom, ...]:
    """Return what a module imports from elsewhere than the standard library.

    Imports inside functions count too. A plain `import` of such a module is refused: it would bind
    a name that a carried module does not have.
    """
    return tuple(_ours(module) if is_within(module.name, RUNTIME) else _imports(module))


_RELATIVE = re.compile(r"^[ ]*from (\.+)([\w.]*) import (\([^)]*\)|[^\n#]*)", re.MULTILINE)


def _ours(module: Module) -> Iterator[ImportFrom]:
    """Yield the same for a module of the runtime, whose form is known: to parse all takes long.

    `tests/compiler/emit/test_embed.py` holds that it has no other imports than Python would find.
    """
    for match in _RELATIVE.finditer(module.text):
        dots, inner, names = match.groups()
        line = module.text.count("\n", 0, match.start()) + 1
        yield ImportFrom(
            target=_target(module, inner, len(dots), line),
            names=tuple(names.strip("()").replace(",", " ").split()),
            line=line,
            column=0,
            written=dots + inner,
        )


def import_statements(text: str) -> Iterator[ast.Import | ast.ImportFrom]:
    """Yield all imports of a module, those inside functions too."""
    left: list[ast.AST] = [ast.parse(text)]
    for node in left:
        if isinstance(node, ast.Import | ast.ImportFrom):
            yield node
        for inner in ("body", "orelse", "finalbody", "handlers", "cases"):  # statements, no more
            left += getattr(node, inner, ())


def _imports(module: Module) -> Iterator[ImportFrom]:
    for node in import_statements(module.text):
        if isinstance(node, ast.Import):
            for alias in node.names:
                if not is_standard(alias.name):
                    raise module.refuse(node.lineno, _no_plain_import(alias.name))
        else:
            target = _target(module, node.module or "", node.level, node.lineno)
            if node.level or not is_standard(target):
                yield ImportFrom(
                    target=target,
                    names=tuple(alias.name for alias in node.names),
                    line=node.lineno,
                    column=node.col_offset,
                    written="." * node.level + (node.module or ""),
                )


def _no_plain_import(name: str) -> str:
    if is_within(name, RUNTIME):
        return f"write `from {name} import …` instead of `import {name}`: the module moves"
    return f"{name} is not of the standard library: it cannot be carried along"


def _target(module: Module, written: str, level: int, line: int) -> str:
    if not level:
        return written
    parts = module.package.split(".")
    if level > len(parts):
        raise module.refuse(line, "the import leads out of its package")
    base = parts[: len(parts) - level + 1]
    return ".".join([*base, written] if written else base)
