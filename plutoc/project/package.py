"""What compiling changes in an app's package, and the package with the developer's own code in it."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from plutoc.check.model import Checked
from plutoc.compile import Compiled
from plutoc.emit.errors import place_of
from plutoc.emit.lock import NAME as LOCK
from plutoc.emit.package import Package
from plutoc.emit.write import Changes, compare, record_of
from plutoc.project.hooks import default_folder, hooks_path, read_module

FLEET = "fleet.toml"
MISSIONS = "missions.toml"
"""What a plan's two files are called that lie beside an app."""


def known_hooks(checked: Checked, folder: Path, *, force: bool = False) -> Mapping[str, str]:
    """Return the hooks that a package remembers; refuse one that is not ours to compile."""
    record = record_of(checked.graph.name, folder, place_of(checked.graph), force=force)
    return record.hooks if record is not None else {}


def changes_of(
    compiled: Compiled, folder: Path, *, asks_for_stubs: bool = False, force: bool = False
) -> Changes:
    """Say what would change. A hooks.py beside the app becomes the package's first one."""
    path, package, asked = hooks_path(compiled.checked.graph), compiled.package, dict[str, str]()
    if compiled.hooks is not None:
        if asks_for_stubs and (folder / path).is_file():
            asked[path] = compiled.hooks.text
        package = replace(package, once={**package.once, path: compiled.hooks.text})
    return compare(package, folder, place_of(compiled.checked.graph), asked=asked, force=force)


def with_own_code(compiled: Compiled, file: Path) -> Package:
    """Return a package of which every file is ours to write, the developer's code included."""
    package, path = compiled.package, hooks_path(compiled.checked.graph)
    texts = {**package.once, **_own_modules(default_folder(file, compiled.checked.graph), package)}
    if compiled.hooks is not None:
        texts[path] = compiled.hooks.text
    return replace(package, owned={**package.owned, **texts}, once={})


def _own_modules(folder: Path, package: Package) -> dict[str, str]:
    """Return the modules that the developer put beside the hooks.py of a generated package."""
    app = folder / "src" / package.name
    if not (folder / LOCK).is_file() or not app.is_dir():
        return {}
    paths = {path.relative_to(folder).as_posix(): path for path in sorted(app.rglob("*.py"))}
    return {
        name: read_module(path).text
        for name, path in paths.items()
        if name not in (*package.owned, *package.once) and "_runtime" not in path.parts
    }


def called(
    modules: Path, module: str, arguments: Sequence[str]
) -> tuple[list[str], dict[str, str]]:
    """Return how a module of a package is called as its user would: the command, the environment.

    `modules` is the folder in which the package's modules are.
    """
    before = os.environ.get("PYTHONPATH")
    path = os.pathsep.join(filter(None, [str(modules), before]))
    # -P: nothing of the folder that we are in counts, the generated package least of all.
    command = [sys.executable, "-P", "-m", module, *arguments]
    return command, {**os.environ, "PYTHONPATH": path}
