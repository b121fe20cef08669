"""Flies an app of seam 2 with this library's copy of the brain, under its modules' former names.

Seam 2 was the brain's modules themselves; the flow and the blocks that such an app carries import a few
of them. So the copy stands in for what the app carries, and is driven as any other brain.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_file_location
from pathlib import Path
from types import ModuleType, SimpleNamespace

from . import shared

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

_COPY = Path(shared.__file__).parent


def provide(brain: str) -> None:
    """Make the library's copy take the place of an app's brain, before the app is loaded or again."""
    if any(isinstance(one, _Copy) and one.brain == brain for one in sys.meta_path):
        return
    sys.meta_path[:0] = [_Former(brain), _Copy(brain)]
    package = brain.rpartition(".")[0]
    kept = (f"{package}.__main__", brain, f"{brain}.command")
    for name in [one for one in sys.modules if one.startswith(f"{package}.") and one not in kept]:
        del sys.modules[name]
    queue, policies = (import_module(f"{brain}.fleet.{one}") for one in ("queue", "policies"))
    policies.__path__ = []  # it was a package
    results = import_module(f"{brain}.domain.model").ResultStore
    results.for_evaluator = import_module(f"{brain}.hooks.context").results_for
    import_module(f"{brain}.flow.run").Run.hook = import_module(f"{brain}.flow.asking").ask
    queue.Queue.enter = _entering(queue.Queue.enter)
    batch = import_module(f"{brain}.fleet.batch")
    for name in ("Policy", "Choice", "Able", "Batch", "lowest"):
        setattr(queue, name, getattr(batch if name == "Batch" else policies, name))


def _entering(enter: Callable[..., object]) -> Callable[..., object]:
    """Let a request be made for trips, too, and not for a mission only."""

    def enter_either(queue: object, what: object, policy: object, priority: int) -> object:
        if isinstance(what, list):
            what = SimpleNamespace(name="", trips=what, deadline=None)
        return enter(queue, what, policy, priority)

    return enter_either


def loaded_again(brain: str) -> object:
    """Return an app that was loaded with its own brain as an app of the library's copy."""
    return import_module(f"{brain.rpartition('.')[0]}.flow").APP


class _Copy(MetaPathFinder):
    """Finds a brain's modules in the library's copy."""

    def __init__(self, brain: str) -> None:
        self.brain = brain

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if not fullname.startswith(f"{self.brain}."):
            return None
        place = _COPY.joinpath(*fullname.removeprefix(f"{self.brain}.").split("."))
        if (place / "__init__.py").is_file():
            home = [str(place)]
            return spec_from_file_location(
                fullname, place / "__init__.py", submodule_search_locations=home
            )
        file = place.with_suffix(".py")
        return spec_from_file_location(fullname, file) if file.is_file() else None


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
        given = vars(import_module(f"{self._brain}{home}"))
        vars(module).update({name: one for name, one in given.items() if name[:2] != "__"})
