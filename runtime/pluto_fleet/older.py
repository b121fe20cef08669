"""Scaffolding: flies an app of seam 2 with today's brain, under its modules' former names.

Seam 2 was the brain's modules themselves; the flow and the blocks that such an app carries import a few
of them. All this goes with the scaffolding.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App

_MOVED = {
    "domain.results": "domain.model",
    "fleet.policies.batch_optimal": "fleet.batch_optimal",
    "fleet.policies.first": "fleet.policies",
    "fleet.policies.least_used": "fleet.policies",
    "fleet.policies.nearest": "fleet.policies",
    "fleet.policies.own": "fleet.own_policy",
    "flow.verdict": "hooks.context",
    "hooks.live_drone": "hooks.context",
    "trips.deadlines": "trips.flight",
}
"""The former modules, and where their names are today."""


def provide(brain: str) -> None:
    """Make today's modules importable by their former names, for the app with this brain."""
    sys.meta_path.insert(0, _Former(brain))
    package = brain.rpartition(".")[0]
    kept = (f"{package}.__main__", brain, f"{brain}.command")
    for name in [one for one in sys.modules if one.startswith(f"{package}.") and one not in kept]:
        del sys.modules[name]
    queue, policies = (
        import_module(f"plutoc_runtime.fleet.{one}") for one in ("queue", "policies")
    )
    policies.__path__ = []  # it was a package
    results = import_module("plutoc_runtime.domain.model").ResultStore
    results.for_evaluator = import_module("plutoc_runtime.hooks.context").results_for
    for name in ("Policy", "Choice", "Able", "Batch", "lowest"):
        setattr(queue, name, getattr(policies, name))


def loaded_again(brain: str) -> App:
    """Return an app that was loaded with its own brain as an app of today's brain."""
    app: App = import_module(f"{brain.rpartition('.')[0]}.flow").APP
    return app


class _Former(MetaPathFinder, Loader):
    """Finds a module by its former name."""

    def __init__(self, brain: str) -> None:
        self._brain = f"{brain}."

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        old = fullname.removeprefix(self._brain)
        if old == fullname or old not in _MOVED:
            return None
        return ModuleSpec(fullname, self)

    def exec_module(self, module: ModuleType) -> None:
        """Fill a former module with the names of those where they are now."""
        home = _MOVED[module.__name__.removeprefix(self._brain)]
        given = vars(import_module(f"plutoc_runtime.{home}"))
        vars(module).update({name: one for name, one in given.items() if name[:2] != "__"})
