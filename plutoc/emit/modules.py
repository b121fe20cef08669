"""The installed modules that are carried along: their text, and what they import."""

from __future__ import annotations

import ast
import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import PurePath
from typing import NamedTuple

import plutoc_runtime
from plutoc.emit.scan import Written, written_imports
from plutoc.installed import files_in

RUNTIME = plutoc_runtime.__name__
_HOME = os.path.dirname(plutoc_runtime.__file__)
_START = "__init__.py"


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

    def refuse(self, at: int, problem: str) -> EmbedError:
        """Return the error for something in it, so many characters from its beginning."""
        line = self.text.count("\n", 0, at) + 1
        return EmbedError(f"{self.file}:{line}: {problem}")


class ImportFrom(NamedTuple):
    """`from target import names`, the target spelled out in full."""

    target: str
    names: tuple[str, ...]
    start: int
    """In characters from the beginning of the module's text."""
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
    path = name.removeprefix(RUNTIME).replace(".", "/")
    here = _files_of_runtime()
    is_package = f"{path}/{_START}" in here
    path = f"{path}/{_START}" if is_package else f"{path}.py"
    if path not in here:
        return None
    file = _HOME + path
    with open(file, "rb", buffering=0) as opened:
        text = opened.readall().decode("utf-8")
    return Module(name=name, file=file, text=text, is_package=is_package)


@cache
def _files_of_runtime() -> frozenset[str]:
    """Return the path of each file of the runtime, from its folder on."""
    return frozenset(path.removeprefix(_HOME).replace(os.sep, "/") for path in files_in(_HOME))


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
        inner = one.target.lstrip(".")
        level = len(one.target) - len(inner)
        if not one.names:
            if not is_standard(one.target):
                raise module.refuse(one.start, _no_plain_import(one.target))
        elif level or not is_standard(one.target):
            yield ImportFrom(
                target=_target(module, inner, level, one.start),
                names=one.names,
                start=one.start,
                written=one.target,
            )


def _imports(module: Module) -> Iterator[ImportFrom]:
    data = module.text.encode()
    starts = [0]
    for text in data.splitlines(keepends=True):
        starts.append(starts[-1] + len(text))
    for node in ast.walk(ast.parse(module.text)):
        if not isinstance(node, ast.Import | ast.ImportFrom):
            continue
        start = len(data[: starts[node.lineno - 1] + node.col_offset].decode())
        if isinstance(node, ast.Import):
            for alias in node.names:
                if not is_standard(alias.name):
                    raise module.refuse(start, _no_plain_import(alias.name))
        else:
            target = _target(module, node.module or "", node.level, start)
            if node.level or not is_standard(target):
                yield ImportFrom(
                    target=target,
                    names=tuple(alias.name for alias in node.names),
                    start=start,
                    written="." * node.level + (node.module or ""),
                )


def _no_plain_import(name: str) -> str:
    if is_within(name, RUNTIME):
        return f"write `from {name} import …` instead of `import {name}`: the module moves"
    return f"{name} is not of the standard library: it cannot be carried along"


def _target(module: Module, written: str, level: int, start: int) -> str:
    if not level:
        return written
    parts = module.package.split(".")
    if level > len(parts):
        raise module.refuse(start, "the import leads out of its package")
    base = parts[: len(parts) - level + 1]
    return ".".join([*base, written] if written else base)
