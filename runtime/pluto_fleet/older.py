"""Scaffolding: flies an app of seam 1 with today's brain, under its modules' former names.

Seam 1 was the brain's modules themselves, all in one folder; the flow and the blocks that such an app
carries import a few of them. All this goes with the scaffolding.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Drone
    from plutoc_runtime.flow.mission import MissionState
    from plutoc_runtime.flow.run import Run
    from plutoc_runtime.trips.flight import Flight

_ROOMS = {
    "domain": (
        "actions airspace app changes:mission_data errors fields geometry guard model quantities results:model"
        " status trace words:text"
    ),
    "time": "kernel signals:future virtual",
    "hooks": "plain:keepable context handle:context verdict:context soundness",
    "fleet": (
        "allocation:queue capability:reach request:queue energy:reach navigation policy:queue"
        " policies policies.assignment:assignment policies.batch_optimal:batch_optimal"
        " policies.first:policies policies.least_used:policies policies.nearest:policies"
        " policies.own:own_policy"
    ),
    "trips": "flight watching:deadlines transitions",
    "flow": (
        "engine state:mission core:mission run judgement modification declared" " session:engine"
    ),
}
"""The new names of former modules."""

_RENAMED = {
    "Signal": "Future",
    "State": "MissionState",
    "WHATEVER": "ANY_ERROR",
    "Kind": "EventKind",
}

_ELSEWHERE = ("domain.errors", "flow.run", "flow.mission")
"""Modules that have taken over parts of former modules."""


def _moved() -> dict[str, str]:
    found = {}
    for room, modules in _ROOMS.items():
        for one in modules.split():
            old, _, new = one.partition(":")
            found[old] = f"{room}.{new or old}"
    return found


def provide(brain: str) -> None:
    """Make today's modules importable by their former names, for the app with this brain."""
    sys.meta_path.insert(0, _Former(brain))
    package = brain.rpartition(".")[0]
    kept = (f"{package}.__main__", brain, f"{brain}.command")
    for name in [one for one in sys.modules if one.startswith(f"{package}.") and one not in kept]:
        del sys.modules[name]


def loaded_again(brain: str) -> App:
    """Return an app that was loaded with its own brain as an app of today's brain."""
    app: App = import_module(f"{brain.rpartition('.')[0]}.flow").APP
    return app


def _of_former_blocks() -> dict[str, object]:
    """Return the functions of former blocks and flows under their former names."""
    from plutoc_runtime.domain.model import ResultStore
    from plutoc_runtime.flow.modification import context_of
    from plutoc_runtime.flow.own_action import OwnAction
    from plutoc_runtime.flow.run import Run
    from plutoc_runtime.hooks.context import results_for

    type.__setattr__(ResultStore, "for_evaluator", results_for)
    type.__setattr__(Run, "context", property(context_of))  # what `run.context` was
    return {"Action": OwnAction, "launch": _launch, "watch": _watch}


def _watch(run: Run[Any], *limits: tuple[Any, ...] | None) -> Flight:
    from plutoc_runtime.flow.run import watch
    from plutoc_runtime.trips.deadlines import Limit

    return watch(run, *(None if limit is None else Limit(*limit) for limit in limits))


def _launch(state: MissionState, drone: Drone) -> None:
    state.launch(drone)


class _Former(MetaPathFinder, Loader):
    """Finds a module by its former name."""

    def __init__(self, brain: str) -> None:
        self._brain = f"{brain}."
        self._moved = _moved()

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        old = fullname.removeprefix(self._brain)
        if old == fullname or old not in self._moved:
            return None
        return ModuleSpec(fullname, self, is_package=old == "policies")

    def exec_module(self, module: ModuleType) -> None:
        """Fill a former module with its present names, and those that have moved elsewhere."""
        old = module.__name__.removeprefix(self._brain)
        given: dict[str, object] = {}
        for home in (*_ELSEWHERE, self._moved[old]):
            given |= vars(import_module(f"plutoc_runtime.{home}"))
        given |= {old: given[new] for old, new in _RENAMED.items() if new in given}
        given |= _of_former_blocks()
        vars(module).update({name: one for name, one in given.items() if not name.startswith("__")})
