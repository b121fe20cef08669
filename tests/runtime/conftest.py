"""The runtime's tests run twice: in place, and on a copy embedded in a package.

`tests/test_embedded_runtime.py` runs them again with PLUTO_EMBEDDED naming a folder that holds a
package `carrier` with a `_runtime`; then every import of the runtime or of a block's step gets the
embedded module instead.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_loader
from types import ModuleType

from pluto_fleet.scaffolding import bind

EMBEDDED = os.environ.get("PLUTO_EMBEDDED")
HOME = "carrier._runtime"


def embedded_name(name: str) -> str | None:
    """Return where an embedded copy has this block's step; None: this is none."""
    if name.startswith("plutoc_blocks.") and name.endswith(".step"):
        return f"{HOME}.blocks.{name.split('.')[1]}"
    return None


class Embedded(MetaPathFinder, Loader):
    """Finds the embedded module in place of the one that is asked for."""

    def __init__(self) -> None:
        self._specs: dict[str, ModuleSpec | None] = {}

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        return spec_from_loader(name, self) if embedded_name(name) else None

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        module = import_module(embedded_name(spec.name) or "")
        self._specs[spec.name] = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        assert module.__spec__ is not None
        module.__spec__ = self._specs[module.__spec__.name]


if EMBEDDED:
    assert not [name for name in sys.modules if embedded_name(name)], "loaded before the copy"
    sys.path.insert(0, EMBEDDED)
    bind(HOME)
    sys.meta_path.insert(0, Embedded())
