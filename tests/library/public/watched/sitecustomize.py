"""Python loads this when it starts, where its folder is on the path: it watches what the library imports.

`plutoc_runtime`, the source of what apps carry, cannot be imported; and each module of an app's `_runtime`
that the library imports is written, with the importing module, as a line of the file PLUTO_IMPORTS.
"""

from __future__ import annotations

import builtins
import importlib
import os
import sys
from collections.abc import Mapping, Sequence
from importlib.abc import MetaPathFinder
from types import ModuleType
from typing import Any

LIBRARY, SOURCE, CARRIED = "pluto_fleet", "plutoc_runtime", "_runtime"


class Missing(MetaPathFinder):
    """Finds no source of the brain."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> None:
        """Raise that there is none."""
        if fullname.partition(".")[0] == SOURCE:
            raise ModuleNotFoundError(f"{SOURCE} is not installed here")


def note(importer: str, name: str) -> None:
    """Write down what the library imports of an app."""
    if importer.partition(".")[0] == LIBRARY and name.split(".")[1:2] == [CARRIED]:
        with open(os.environ["PLUTO_IMPORTS"], "a", encoding="utf-8") as file:
            file.write(f"{importer} {name}\n")


_import, _import_module = builtins.__import__, importlib.import_module


def importing(
    name: str,
    globals: Mapping[str, Any] | None = None,
    locals: Mapping[str, Any] | None = None,
    fromlist: Sequence[str] | None = (),
    level: int = 0,
) -> ModuleType:
    """Carry out an `import` statement."""
    if not level:
        importer = str((globals or {}).get("__name__", ""))
        for target in (name, *(f"{name}.{one}" for one in fromlist or ())):
            note(importer, target)
    return _import(name, globals, locals, fromlist or (), level)


def import_module(name: str, package: str | None = None) -> ModuleType:
    """Import a module by its name."""
    note(str(sys._getframe(1).f_globals.get("__name__", "")), name)
    return _import_module(name, package)


sys.meta_path.insert(0, Missing())
builtins.__import__ = importing
importlib.import_module = import_module
