"""Lets the compiled apps that a test imports share this process's brain: the library has room for one.

An app's program has a process of its own, where the library takes the brain that the app carries.
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

_OF_AN_APP = re.compile(r"(?P<app>\w+)\._runtime(?P<inner>\..+)?")
"""A module that an app carries."""
BLOCKS = ".blocks"


class OneBrain(MetaPathFinder, Loader):
    """Finds `plutoc_runtime.x` in place of any `<app>._runtime.x`."""

    def __init__(self) -> None:
        self._specs: dict[str, ModuleSpec | None] = {}

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return where a module of the brain is; an app's blocks stay its own."""
        found = _OF_AN_APP.fullmatch(name)
        if found is None:
            return None
        inner = found["inner"] or ""
        if f"{inner}.".startswith(f"{BLOCKS}."):
            home = Path(sys.modules[found["app"]].__path__[0], "_runtime")
            above = inner.split(".")[1:-1]
            return PathFinder.find_spec(name, [str(home.joinpath(*above))])
        return spec_from_loader(name, self)

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """Return the module that is shared."""
        found = _OF_AN_APP.fullmatch(spec.name)
        assert found is not None
        module = import_module(f"plutoc_runtime{found['inner'] or ''}")
        self._specs[spec.name] = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        """Leave the module's own name to it: the import system has put the other one there."""
        assert module.__spec__ is not None
        module.__spec__ = self._specs[module.__spec__.name]


def share_one_brain() -> None:
    """Have every app that this process imports share its brain, from now on."""
    sys.meta_path.insert(0, OneBrain())
