"""Checking a class that a fleet file names, before anything flies.

Its source is examined first, so that nothing is run only because a fleet file names it. If there is such a
class, its module is imported, first in another process, as the import may hang or end the process. Then
its methods are checked; none is called, and types are left to mypy.
The source behind an entry point of an installed package is not examined.
"""

from __future__ import annotations

import ast
import inspect
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import suppress
from importlib.machinery import ModuleSpec
from importlib.util import resolve_name
from tempfile import TemporaryFile
from typing import IO, NamedTuple

from ..shared.domain.errors import BadInput
from ..shared.domain.text import duration, quoted
from . import plugins
from .plugins import CallStyle, Method, PluginKind
from .timeouts import shortened

_MOST_IMPORTS = 8
"""The longest chain of re-exports of a class."""


class _Lookup(NamedTuple):
    """The class that is looked for, for messages that it does not exist."""

    kind: PluginKind
    name: str
    far: int = 0
    """The length of the chain of re-exports so far."""

    def refused(self, why: str) -> BadInput:
        """Return the error with a reason."""
        return self.kind.refused(self.name, why)


def look_up(kind: PluginKind, name: str, module: str, path: str) -> None:
    """Raise `BadInput` if a module does not exist, or has no such class; nothing of it is run."""
    if module not in sys.modules:  # it has been imported already
        _look(_Lookup(kind, name), module, path.split("."))


def _look(sought: _Lookup, module: str, path: Sequence[str]) -> None:
    if module.partition(".")[0] in sys.stdlib_module_names:
        raise sought.refused(f"is none: {quoted(module)} is a module of Python's own")
    spec = _spec(sought, module)
    body = _body(sought, spec)
    bases: Sequence[ast.expr] = ()
    for at, part in enumerate(path):
        rest = path[at + 1 :]
        match _last(body, part):
            case ast.ClassDef() as found:
                if not rest:
                    _refuse_what_has_nothing(sought, found)
                body, bases = found.body, found.bases
            case ast.ImportFrom() as found:
                return _follow(sought, spec, found, [_original(found, part), *rest])
            case ast.FunctionDef() | ast.AsyncFunctionDef():
                raise sought.refused("is no class")
            case None if at == 0:
                return _look_further(sought, spec, body, part, rest)
            case None if not bases:
                raise plugins.no_such_class(sought.kind, sought.name, part, _classes(body))
            case _:  # only running it would tell
                return None
    return None


def _look_further(
    sought: _Lookup, spec: ModuleSpec, body: Sequence[ast.stmt], part: str, rest: Sequence[str]
) -> None:
    """Look for a name that a module does not bind itself: a submodule, or a star import."""
    if rest and spec.submodule_search_locations is not None and _found(spec, part):
        return _look(sought, f"{spec.name}.{part}", rest)
    star = _last(body, "*")
    if isinstance(star, ast.ImportFrom):
        return _follow(sought, spec, star, [part, *rest])
    if _last(body, "__getattr__") is None or part not in _texts(body):
        raise plugins.no_such_class(sought.kind, sought.name, part, _classes(body))
    return None


def _follow(sought: _Lookup, spec: ModuleSpec, found: ast.ImportFrom, path: Sequence[str]) -> None:
    """Follow the import of a name."""
    if sought.far == _MOST_IMPORTS:
        raise plugins.no_such_class(sought.kind, sought.name, path[0], ())
    package = spec.name if spec.submodule_search_locations is not None else spec.parent
    try:
        target = resolve_name("." * found.level + (found.module or ""), package)
    except ImportError:
        raise plugins.no_such_class(sought.kind, sought.name, path[0], ()) from None
    farther = sought._replace(far=sought.far + 1)
    if len(path) > 1 and _found(_spec(farther, target), path[0]):
        return _look(farther, f"{target}.{path[0]}", path[1:])
    return _look(farther, target, path)


def _spec(sought: _Lookup, module: str) -> ModuleSpec:
    """Return a module's spec, without importing its parents."""
    spec: ModuleSpec | None = None
    parts = module.split(".")
    for number, part in enumerate(parts, 1):
        spec = _found(spec, part)
        if spec is None:
            missing = ".".join(parts[:number])
            refuse = plugins.needs if sought.far else plugins.no_such_module
            raise refuse(sought.kind, sought.name, missing)
    assert spec is not None
    return spec


def _found(above: ModuleSpec | None, part: str) -> ModuleSpec | None:
    name = part if above is None else f"{above.name}.{part}"
    known: ModuleSpec | None = getattr(sys.modules.get(name), "__spec__", None)
    if known is not None:
        return known
    where = None if above is None else above.submodule_search_locations
    if above is not None and where is None:
        return None
    for finder in sys.meta_path:
        find = getattr(finder, "find_spec", None)
        spec: ModuleSpec | None = find(name, where, None) if find is not None else None
        if spec is not None:
            return spec
    return None


def _body(sought: _Lookup, spec: ModuleSpec) -> Sequence[ast.stmt]:
    """Return a module's syntax tree; raise `BadInput` if it cannot be read."""
    read = getattr(spec.loader, "get_source", None)
    try:
        text: str | None = None if read is None else read(spec.name)
        if text is not None:
            return ast.parse(text).body
    except (ImportError, OSError, SyntaxError, ValueError, RecursionError, MemoryError) as error:
        why = shortened(f"{type(error).__name__}: {error}")
        raise sought.refused(f"cannot be imported: {why}") from error
    raise sought.refused(
        f"cannot be looked up: {quoted(spec.name)} has no text in Python;"
        f" its package can offer the class by an entry point, {sought.kind.group}"
    )


def _statements(body: Sequence[ast.stmt]) -> Iterator[ast.stmt]:
    """Yield the statements that bind names at the module's level."""
    for one in body:
        yield one
        if not isinstance(one, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            for inner in ast.iter_child_nodes(one):
                if isinstance(inner, ast.stmt):
                    yield from _statements([inner])
                elif isinstance(inner, ast.ExceptHandler | ast.match_case):
                    yield from _statements(inner.body)


def _last(body: Sequence[ast.stmt], name: str) -> ast.stmt | None:
    """Return the last statement that binds a name, preferably a class."""
    found = [one for one in _statements(body) if name in _names(one)]
    classes = [one for one in found if isinstance(one, ast.ClassDef)]
    return [None, *found, *classes][-1]


def _names(one: ast.stmt) -> Iterator[str]:
    match one:
        case ast.ClassDef(name=name) | ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
            yield name
        case ast.ImportFrom(names=names):
            yield from (alias.asname or alias.name for alias in names)
        case ast.Assign() | ast.AnnAssign():
            targets = one.targets if isinstance(one, ast.Assign) else [one.target]
            for target in targets:
                yield from (at.id for at in ast.walk(target) if isinstance(at, ast.Name))
        case _:
            return


def _original(found: ast.ImportFrom, name: str) -> str:
    return next(alias.name for alias in found.names if (alias.asname or alias.name) == name)


def _classes(body: Sequence[ast.stmt]) -> list[str]:
    return [one.name for one in _statements(body) if isinstance(one, ast.ClassDef)]


def _texts(body: Sequence[ast.stmt]) -> set[object]:
    """Return the string literals of a module: a name from `__getattr__` is one of them."""
    nodes = (node for one in body for node in ast.walk(one))
    return {node.value for node in nodes if isinstance(node, ast.Constant)}


def _refuse_what_has_nothing(sought: _Lookup, found: ast.ClassDef) -> None:
    """Raise `BadInput` for a class without bases that has none of the required methods."""
    if found.bases or found.keywords or found.decorator_list:
        return
    has = {name for one in _statements(found.body) for name in _names(one)}
    wanted = [method.name for method in sought.kind.methods]
    if has.isdisjoint(wanted):
        lacks = "; ".join(f"it has no method {name}" for name in wanted)
        raise sought.refused(f"cannot be used: {lacks}")


IMPORT_LIMIT = 20.0
"""The time-out of an import, in seconds."""

_IMPORTED = 93
"""The exit code after a completed import; if that has raised, it will do so here, too."""

_PROGRAM = "\n".join(
    (
        "import os, sys",
        "from importlib import import_module",
        "name, *sys.path = sys.argv[1:]",
        "try:",
        "    import_module(name)",
        "except BaseException:",
        "    pass",
        f"os._exit({_IMPORTED})",
    )
)


def try_import(kind: PluginKind, name: str, module: str) -> None:
    """Raise `BadInput` if the import of a module does not end, or ends the process."""
    if module in sys.modules:
        return
    command = [sys.executable, "-c", _PROGRAM, module, *sys.path]
    with TemporaryFile() as said:
        try:
            code = subprocess.run(
                command,
                stdin=subprocess.DEVNULL,
                stdout=said,
                stderr=said,
                timeout=IMPORT_LIMIT,
                check=False,
            ).returncode
        except subprocess.TimeoutExpired:
            late = f"was not done with that in {duration(IMPORT_LIMIT)}"
            raise kind.refused(name, _not_imported(module, late, said)) from None
        if code != _IMPORTED:
            ends = f"ends the process that imports it ({_how(code)})"
            raise kind.refused(name, _not_imported(module, ends, said))


def _not_imported(module: str, why: str, said: IO[bytes]) -> str:
    """Return the error for a failed import, with its last line of output."""
    said.seek(0)
    lines = said.read().decode("utf-8", "replace").strip().splitlines()
    last = f"; the last it said: {shortened(lines[-1])}" if lines else ""
    return f"cannot be imported: {quoted(module)} {why}{last}"


def _how(code: int) -> str:
    with suppress(ValueError):
        return f"killed by {signal.Signals(-code).name}"
    return f"exit code {code}"


_NOTHING = object()


def problems(kind: PluginKind, made: type) -> list[str]:
    """Return all that is wrong with a class of this kind."""
    found: list[str] = []
    if not _takes(made, [kind.argument]):
        found.append(f"it cannot be made: its __init__ must take ({kind.argument})")
    for method in kind.methods:
        found += _of_method(made, method)
    for group in kind.together:
        there = [method for method in group if _attribute(made, method) is not _NOTHING]
        for method in group if there else ():
            if method in there:
                found += _of_method(made, method)
            else:
                found.append(f"it has {there[0].name} but no {method.name}: both belong together")
    return found


def _of_method(made: type, method: Method) -> Iterator[str]:
    attribute = _attribute(made, method)
    if method.shape is CallStyle.PROPERTY:
        if inspect.isroutine(attribute):  # a missing one may be set by `__init__`
            yield "its telemetry must be a property: put @property above it"
        return
    if attribute is _NOTHING:
        yield f"it has no method {method.name}"
        return
    if not callable(attribute):
        yield f"its {method.name} is no method"
        return
    written = inspect.unwrap(attribute)
    waits, iterates = inspect.iscoroutinefunction(written), inspect.isasyncgenfunction(written)
    if method.shape is CallStyle.WAITS and not waits:
        yield f"its {method.name} must be `async def`"
    elif method.shape is CallStyle.AT_ONCE and (waits or iterates):
        yield f"its {method.name} must be `def`, not `async def`"
    elif method.shape is CallStyle.ITERATES and waits:
        yield (
            f"its {method.name} must be an async generator, or `def` and return an async iterator"
        )
    elif method.of_class and not _stands_alone(made, method):
        yield f"its {method.name} must be a staticmethod: it is called before there is a drone"
    elif not _takes(attribute, _arguments(made, method)):
        takes = f"({', '.join(method.takes)})" if method.takes else "nothing"
        yield f"its {method.name} cannot be called so: it takes {takes}"


def _attribute(made: type, method: Method) -> object:
    return getattr(made, method.name, _NOTHING)


def _arguments(made: type, method: Method) -> list[str]:
    """Return the arguments of a method, looked up on the class, with the object itself."""
    return [*([] if _stands_alone(made, method) else ["self"]), *method.takes]


def _stands_alone(made: type, method: Method) -> bool:
    """Return whether a method needs no object."""
    return isinstance(inspect.getattr_static(made, method.name), (staticmethod, classmethod))


def _takes(called: object, arguments: list[str]) -> bool:
    """Return whether something can be called with this many arguments; unknown counts as yes."""
    if not callable(called):
        return False
    try:
        signature = inspect.signature(called)
    except (TypeError, ValueError):  # not written in Python
        return True
    try:
        signature.bind(*arguments)
    except TypeError:
        return False
    return True
