"""Lets all that a test imports share one brain: the compiler's, the library's copy, and those of apps.

So a test can make an app of its own, compile one beside it, and compare what comes of both. In an app's
program the library and the app have each their own; tests/library/public flies such programs.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import spec_from_loader
from pathlib import Path
from types import ModuleType

ONE = "plutoc_runtime"
_ANOTHER = re.compile(r"((?P<app>\w+)\._runtime|pluto_fleet\.shared)(?P<inner>\..+)?")
"""A module of the brain that an app carries, or of the library's copy."""
BLOCKS = ".blocks"


class OneBrain(MetaPathFinder, Loader):
    """Finds `plutoc_runtime.x` in place of any `<app>._runtime.x`; an app's blocks stay its own."""

    def __init__(self) -> None:
        self._specs: dict[str, ModuleSpec | None] = {}

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return where a module of the brain is, or of an app's blocks."""
        found = _ANOTHER.fullmatch(name)
        inner = "" if found is None else found["inner"] or ""
        if found is None or not f"{inner}.".startswith(f"{BLOCKS}."):
            return None if _brain(name) is None else spec_from_loader(name, self)
        home = Path(sys.modules[found["app"]].__path__[0], "_runtime")
        above = inner.split(".")[1:-1]
        return PathFinder.find_spec(name, [str(home.joinpath(*above))])

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """Return the module that is shared."""
        home = _brain(spec.name)
        assert home is not None
        module = import_module(home)
        self._specs[spec.name] = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        """Leave the module's own name to it: the import system has put the other one there."""
        assert module.__spec__ is not None
        module.__spec__ = self._specs[module.__spec__.name]


def _brain(name: str) -> str | None:
    found = _ANOTHER.fullmatch(name)
    if found is not None and found["app"] and not _is_app(found["app"]):
        return None
    return None if found is None else f"{ONE}{found['inner'] or ''}"


def _is_app(package: str) -> bool:
    """Return whether a package that is imported carries a brain; others may have a `_runtime.py`."""
    return any(Path(home, "_runtime").is_dir() for home in sys.modules[package].__path__)


def share_one_brain() -> None:
    """Have every app that this process imports share its brain, from now on."""
    sys.meta_path.insert(0, OneBrain())
