"""Scaffolding: gives the library the app's own brain under the name `plutoc_runtime`.

The library says `from plutoc_runtime.kernel import Kernel`; in an app's process that is the very module
`<app>._runtime.kernel`. What an app does not carry, because its graph needs none of it, comes from the
library's copy. All this goes once the seam is plain data.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import find_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

BRAIN = "plutoc_runtime"

_HERE = Path(__file__).parent
_COPY = _HERE / "_brain"
"""The brain that the library is built with; an editable install has it beside itself instead."""

_bound = BRAIN


def bind(brain: str) -> None:
    """Let the library use this brain from now on: an app's `_runtime`; once a process."""
    global _bound
    if brain == _bound:
        return
    if BRAIN in sys.modules:
        raise RuntimeError(f"{_bound} is this process's brain already: it cannot be {brain}, too")
    _bound = brain
    sys.meta_path.insert(0, _Brain())


def app_package() -> str:
    """Return the package whose program this is: the app's; the library itself where there is none."""
    return __package__ if _bound == BRAIN else _bound.rpartition(".")[0]


class _Brain(MetaPathFinder):
    """Finds the brain's modules where they are."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if fullname != BRAIN and not fullname.startswith(f"{BRAIN}."):
            return None
        inner = fullname.removeprefix(BRAIN)
        if find_spec(_bound + inner) is not None:
            return ModuleSpec(fullname, _SameModule(_bound + inner))
        parts = inner.removeprefix(".").split(".")
        folder = _COPY if _COPY.is_dir() else _HERE.parent / BRAIN
        file = folder.joinpath(*parts)
        package = file / "__init__.py"
        if package.is_file():
            return spec_from_file_location(
                fullname, package, submodule_search_locations=[str(file)]
            )
        return spec_from_file_location(fullname, file.with_suffix(".py"))


class _SameModule(Loader):
    """Gives a module that has another name, as it is."""

    def __init__(self, name: str) -> None:
        self._module = import_module(name)
        self._spec = self._module.__spec__

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        return self._module

    def exec_module(self, module: ModuleType) -> None:
        module.__spec__ = self._spec  # the import system has put the other name's there
