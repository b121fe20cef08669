"""Embedding code in a generated package: the runtime's modules, the blocks' steps, and the library.

A module of the runtime is copied byte for byte. A module of a block is copied with its imports bent to where things are now,
and not a byte more: `plutoc_runtime` becomes dots, and a module of the block's own package, however
it was imported, the file beside it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from plutoc.emit.modules import RUNTIME, EmbedError, Module, imports_from, is_within, load
from plutoc.registry import STD

FOLDER = "_runtime"
BLOCKS = "blocks"
OURS = STD
"""Carried code of this package lies in the blocks' folder itself; other packages' in one more."""
LIBRARY = "pluto_fleet"
LIBRARY_FOLDER = "_fleet"
BRAIN = f"{LIBRARY}/shared"
"""Where the library has its copy of the brain; in a checkout it is a link, which is not followed."""


class NoLibrary(Exception):
    """The library to carry is not installed. The message says what to install."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Carried:
    """A function of an installed package that generated code calls."""

    package: str
    """The entry point of the block that needs it."""
    function: Callable[..., Any]

    @property
    def module(self) -> str:
        """The installed module that it is in."""
        return self.function.__module__

    @property
    def name(self) -> str:
        """Its name there."""
        return self.function.__name__

    @property
    def home(self) -> str:
        """The module that generated code imports it from."""
        return "." + _path(self.package, self.module).removesuffix(".py").replace("/", ".")


def embed(functions: Iterable[Carried], runtime_modules: Iterable[str]) -> Mapping[str, str]:
    """Return the files to carry along, by their path inside the package, in order of path.

    They are those that the functions and these modules of the runtime need, and no others.
    """
    embedding = _Embedding()
    for carried in functions:
        _check(carried)
        embedding.add(carried.package, carried.module)
    for name in runtime_modules:
        embedding.add(OURS, name)
    return dict(sorted(embedding.files.items()))


@dataclass(slots=True, kw_only=True, eq=False)
class _Embedding:
    """What has been collected so far."""

    files: dict[str, str] = field(default_factory=dict)
    sources: dict[str, str] = field(default_factory=dict)
    """The installed module that each file comes from."""
    added: set[tuple[str, str]] = field(default_factory=set)
    """The modules that were added, and for which package of blocks."""

    def add(self, package: str, name: str) -> None:
        """Add an installed module and everything that it needs."""
        if (package, name) in self.added:
            return
        self.added.add((package, name))
        path = _path(package, name)
        if path in self.sources:
            if self.sources[path] != name:
                raise EmbedError(
                    f"{name} and {self.sources[path]} would both become {path}: rename one"
                )
            return
        module = load(name)
        if module is None:
            raise EmbedError(f"the text of module {name} cannot be read")
        self.sources[path] = name
        if is_within(name, RUNTIME):
            self.files[path] = module.text
            needed = _of_runtime(module)
        else:
            self.files[path] = _moved(module, package)
            self._packages(package)
            needed = _of_block(module)
        for other in needed:
            self.add(package, other)

    def _packages(self, package: str) -> None:
        self.files.setdefault(f"{FOLDER}/{BLOCKS}/__init__.py", '"""The blocks of the app."""\n')
        self.add(OURS, RUNTIME)
        if package != OURS:
            if f"{_folder(package)}.py" in self.files:
                raise EmbedError(
                    f"the package {package} and a standard block would both be {_folder(package)}"
                )
            text = f'"""The blocks of the package {package}."""\n'
            self.files.setdefault(f"{_folder(package)}/__init__.py", text)


def _folder(package: str) -> str:
    inner = "" if package == OURS else f"/{package}"
    return f"{FOLDER}/{BLOCKS}{inner}"


def _path(package: str, name: str) -> str:
    """Return the file that an installed module becomes."""
    if name == RUNTIME:
        return f"{FOLDER}/__init__.py"
    if is_within(name, RUNTIME):
        module = load(name)
        inner = name.removeprefix(f"{RUNTIME}.").replace(".", "/")
        return f"{FOLDER}/{inner}{'/__init__' if module and module.is_package else ''}.py"
    return f"{_folder(package)}/{_flat(name)}.py"


def _flat(name: str) -> str:
    """Return the file name of a block's module: `survey.scan.step` becomes `scan`."""
    _, *parts = name.split(".")
    if len(parts) > 1 and parts[-1] == "step":
        parts.pop()
    return "_".join(parts) or name


def _of_runtime(module: Module) -> Iterator[str]:
    """Yield the modules that a module of the runtime needs, its packages' own included."""
    package = module.name.rpartition(".")[0]
    if package:
        yield package
    for one in imports_from(module):
        if not is_within(one.target, RUNTIME) or not one.written.startswith("."):
            raise module.refuse(
                one.line, f"{one.written}: the runtime imports the standard library and itself"
            )
        yield from _targets(one.target, one.names)


def _of_block(module: Module) -> Iterator[str]:
    """Yield the modules that a module of a block needs."""
    for one in imports_from(module):
        if is_within(one.target, RUNTIME):
            yield from _targets(one.target, one.names)
        else:
            yield one.target


def _targets(target: str, names: tuple[str, ...]) -> Iterator[str]:
    """Yield the module, and those of the names that are modules of it."""
    yield target
    module = load(target)
    if module is not None and module.is_package:
        for name in names:
            if load(f"{target}.{name}") is not None:
                yield f"{target}.{name}"


def _moved(module: Module, package: str) -> str:
    """Return a block's module with its imports rewritten."""
    up = ".." if package == OURS else "..."
    lines = module.text.encode().splitlines(keepends=True)
    for one in sorted(imports_from(module), key=lambda one: (one.line, one.column), reverse=True):
        if is_within(one.target, RUNTIME):
            new = up + one.target.removeprefix(RUNTIME).removeprefix(".")
        else:
            _check_own(module, one.target, one.line)
            new = f".{_flat(one.target)}"
        line = lines[one.line - 1]
        old = re.compile(rf"(from\s+){re.escape(one.written)}(?=\s)".encode())
        match = old.match(line, one.column)
        if match is None:
            raise module.refuse(one.line, f"write `from {one.written} import …` on one line")
        lines[one.line - 1] = line[: match.end(1)] + new.encode() + line[match.end() :]
    return b"".join(lines).decode()


def _check_own(module: Module, target: str, line: int) -> None:
    own = module.name.partition(".")[0]
    if not is_within(target, own):
        raise module.refuse(
            line, f"{target} is neither of the standard library nor of {RUNTIME} nor of {own}"
        )
    found = load(target)
    if found is None or found.is_package:
        raise module.refuse(
            line, f"{target} is not a module with a file of its own: it cannot be carried along"
        )


def _check(carried: Carried) -> None:
    function = carried.function
    module = load(carried.module)
    where = module.file if module else carried.module
    name = getattr(function, "__qualname__", repr(function))
    if "." in name or not name.isidentifier():
        raise EmbedError(f"{where}: {name} must be a function at the top of its module")


def carried_library() -> Mapping[str, str]:
    """Return the library's files, by their path inside the package; it is read and not imported."""
    found = _files(LIBRARY, f"{LIBRARY_FOLDER}/{LIBRARY}")
    if f"{LIBRARY_FOLDER}/{BRAIN}/__init__.py" not in found:
        found.update(_files("plutoc_runtime", f"{LIBRARY_FOLDER}/{BRAIN}"))
    return dict(sorted(found.items()))


def _files(package: str, into: str) -> dict[str, str]:
    spec = find_spec(package)
    if spec is None or spec.origin is None:
        raise NoLibrary(f"{package} is not installed here: pip install pluto-fleet")
    home = Path(spec.origin).parent
    return {
        f"{into}/{path.relative_to(home).as_posix()}": path.read_text("utf-8")
        for path in sorted(home.rglob("*"))
        if path.is_file() and "__pycache__" not in path.parts
    }
