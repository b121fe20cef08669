"""Scaffolding: gives the library the app's own brain under the name `plutoc_runtime`.

The library says `from plutoc_runtime.time.kernel import Kernel`; in an app's process that is the very module
`<app>._runtime.time.kernel`. Modules that an app does not carry come from the library's copy, and so do all of
them in a process without an app. All this goes once the seam is plain data.
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

BRAIN, LIBRARY = "plutoc_runtime", "pluto_fleet"

_HERE = Path(__file__).parent
_COPY = _HERE / "_brain"
"""The library's copy of the brain; an editable install has it beside itself instead."""

_bound = BRAIN


def provide_brain() -> None:
    """Make the library's own copy of the brain importable, for a process without an app."""
    if _COPY.is_dir():
        sys.meta_path.insert(0, _Copy(BRAIN))


def bind(brain: str, *, carries: bool = True) -> None:
    """Make the library use an app's `_runtime` as its brain; once per process.

    An app that carries an older one gets the library's copy in its place.
    """
    global _bound
    if brain == _bound:
        return
    if BRAIN in sys.modules:
        raise RuntimeError(f"{_bound} is this process's brain already: it cannot be {brain}, too")
    _bound = brain
    sys.meta_path.insert(0, _Brain())
    if carries:
        sys.meta_path.append(_Copy(brain))
    else:
        sys.meta_path.insert(0, _Copy(brain))


def app_package() -> str:
    """Return the package of the running program: the app's, or the library's if there is none."""
    return LIBRARY if _bound == BRAIN else _bound.rpartition(".")[0]


class _Brain(MetaPathFinder):
    """Finds `plutoc_runtime` in the app's package."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if not f"{fullname}.".startswith(f"{BRAIN}."):
            return None
        same = _bound + fullname.removeprefix(BRAIN)
        return None if find_spec(same) is None else ModuleSpec(fullname, _SameModule(same))


class _Copy(MetaPathFinder):
    """Finds a brain's modules in the library's copy: those that an app does not carry, or all."""

    def __init__(self, brain: str) -> None:
        self._brain = brain

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if not f"{fullname}.".startswith(f"{self._brain}."):
            return None
        folder = _COPY if _COPY.is_dir() else _HERE.parent / BRAIN
        place = folder.joinpath(*fullname.removeprefix(self._brain).split(".")[1:])
        if (place / "__init__.py").is_file():
            home = [str(place)]
            return spec_from_file_location(
                fullname, place / "__init__.py", submodule_search_locations=home
            )
        file = place.with_suffix(".py")
        return spec_from_file_location(fullname, file) if file.is_file() else None


class _SameModule(Loader):
    """Loads a module that is already loaded under another name."""

    def __init__(self, name: str) -> None:
        self._module = import_module(name)
        self._spec = self._module.__spec__

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        return self._module

    def exec_module(self, module: ModuleType) -> None:
        module.__spec__ = self._spec  # the import system has put the other name's there
