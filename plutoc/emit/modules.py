"""The installed modules that are carried along: their text, and what they import."""

from __future__ import annotations

import ast
import os
import sys
from collections.abc import Iterator
from functools import cache
from importlib.util import find_spec
from pathlib import PurePath

import plutoc_runtime
from plutoc.emit.scan import Written, written_imports
from plutoc.frozen import frozen

RUNTIME = plutoc_runtime.__name__
_HOME = os.path.dirname(plutoc_runtime.__file__)
_DATA = (".css", ".html", ".js", ".svg")
"""What a package of the runtime has beside its modules: pages for browsers."""
_START = "__init__.py"


class EmbedError(Exception):
    """An installed module cannot be carried along. The message says where and what to change."""


@frozen
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


@frozen
class ImportFrom:
    """`from target import names`, the target spelled out in full."""

    target: str
    names: tuple[str, ...]
    line: int
    offset: int
    """Bytes from the start of the module's text."""
    written: str
    """The target as the line has it, dots included."""


@cache
def load(name: str) -> Module | None:
    """Return an installed module's text; None where there is no such module."""
    if is_within(name, RUNTIME) and os.path.isdir(_HOME):
        return _of_runtime(name)
    try:
        spec = find_spec(name)
    except ModuleNotFoundError:  # what should be a package on the way there is none
        return None
    if spec is None or spec.origin is None or spec.loader is None:
        return None
    get_data = getattr(spec.loader, "get_data", None)
    if get_data is None or PurePath(spec.origin).suffix != ".py":
        return None
    data: bytes = get_data(spec.origin)
    return Module(
        name=name,
        file=spec.origin,
        text=data.decode("utf-8"),
        is_package=spec.submodule_search_locations is not None,
    )


def _of_runtime(name: str) -> Module | None:
    """Return a module of the runtime: where that is known, Python need not search."""
    path = os.path.join(_HOME, *name.split(".")[1:])
    is_package = os.path.isdir(path)
    file = os.path.join(path, _START) if is_package else f"{path}.py"
    try:
        with open(file, "rb") as opened:
            text = opened.read().decode("utf-8")
    except FileNotFoundError:
        return None
    return Module(name=name, file=file, text=text, is_package=is_package)


def data_of(package: Module) -> Iterator[tuple[str, str]]:
    """Yield the path and the text of each file of a package that is no Python, in order of path.

    Those in folders within it count, unless they are packages themselves.
    """
    for path in sorted(_data(os.path.dirname(package.file), "")):
        file = os.path.join(os.path.dirname(package.file), *path.split("/"))
        with open(file, "rb") as opened:
            yield path, opened.read().decode("utf-8")


def _data(folder: str, path: str) -> Iterator[str]:
    with os.scandir(folder) as found:
        entries = list(found)
    if path and any(entry.name == _START for entry in entries):
        return
    for entry in entries:
        if entry.is_dir():
            yield from _data(entry.path, f"{path}{entry.name}/")
        elif entry.name.endswith(_DATA):
            yield path + entry.name


def is_within(name: str, package: str) -> bool:
    """Say whether a module is a package, or in it."""
    return name == package or name.startswith(f"{package}.")


def is_standard(name: str) -> bool:
    """Say whether a module is Python's own."""
    return name.partition(".")[0] in sys.stdlib_module_names


@cache
def imports_from(module: Module) -> tuple[ImportFrom, ...]:
    """Return what a module imports from elsewhere than the standard library.

    Imports inside functions count too. A plain `import` of such a module is refused: it would bind
    a name that a carried module does not have.
    """
    written = written_imports(module.text, strange=not is_within(module.name, RUNTIME))
    return tuple(_imports(module) if written is None else _scanned(module, written))


def _scanned(module: Module, written: list[Written]) -> Iterator[ImportFrom]:
    """Yield the same as `_imports`, for a module whose texts say it plainly."""
    for one in written:
        line = module.text.count("\n", 0, one.start) + 1
        level = len(one.target) - len(one.target.lstrip("."))
        if not one.names:
            if not is_standard(one.target):
                raise module.refuse(line, _no_plain_import(one.target))
        elif level or not is_standard(one.target):
            yield ImportFrom(
                target=_target(module, one.target[level:], level, line),
                names=one.names,
                line=line,
                offset=len(module.text[: one.start].encode()),
                written=one.target,
            )


def _imports(module: Module) -> Iterator[ImportFrom]:
    starts = [0]
    for text in module.text.encode().splitlines(keepends=True):
        starts.append(starts[-1] + len(text))
    for node in ast.walk(ast.parse(module.text)):
        if isinstance(node, ast.Import):
            for alias in node.names:
                if not is_standard(alias.name):
                    raise module.refuse(node.lineno, _no_plain_import(alias.name))
        elif isinstance(node, ast.ImportFrom):
            target = _target(module, node.module or "", node.level, node.lineno)
            if node.level or not is_standard(target):
                yield ImportFrom(
                    target=target,
                    names=tuple(alias.name for alias in node.names),
                    line=node.lineno,
                    offset=starts[node.lineno - 1] + node.col_offset,
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
