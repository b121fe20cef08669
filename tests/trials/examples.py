"""The examples and other apps in memory, on the runtime in place: tests can plant mistakes in that."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from importlib import import_module
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Any

from pluto_fleet.app import described
from pluto_fleet.files.fleet import FleetFile, load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.shared.domain.model import Mission
from plutoc.check.model import Checked
from plutoc.compile import analyse, planned
from plutoc.emit.stubs import exports_of
from plutoc.source import Source
from tests.equivalence.flows import Package, in_memory, packaged
from tests.kit.apps import EXAMPLES

if TYPE_CHECKING:
    from pluto_fleet.app import App


@lru_cache
def checked(name: str) -> Checked:
    """Return an example's checked graph."""
    path = EXAMPLES / name / "app.pluto"
    return analyse(Source(path.name, path.read_text(encoding="utf-8")))[0]


def example(name: str) -> App:
    """Return an example's app."""
    package = packaged(planned(checked(name)))
    hooks = SimpleNamespace(**vars(_hooks(name, package)))
    return described(package.app(hooks, patient=True))


WAITING = """
    pluto 1
    app patient {
      create = MissionCreator
      wait = Clock
      allocate = DroneAllocator
      launch = TripLauncher
      watch = TripMonitor
      start -> create -> wait -> allocate -> launch -> watch -> end
      watch -> wait when STANDBY
    }
    """
"""An app whose trips wait for their delays."""


def app_of(text: str, hooks: Mapping[str, Callable[..., object]] | None = None) -> App:
    """Return the app of a source, with the hooks that it needs."""
    package = packaged(planned(analyse(Source("app.pluto", text))[0]))
    return described(package.app(SimpleNamespace(**(hooks or {})), patient=True))


def fleet_of(name: str, app: App) -> FleetFile:
    """Return an example's fleet file."""
    return load_fleet(EXAMPLES / name / "fleet.toml", app)


def missions_of(name: str, app: App, fleet: FleetFile) -> list[Mission[Any]]:
    """Return an example's own missions."""
    return load_missions(EXAMPLES / name / "missions.toml", app, fleet.airspace)


def _hooks(name: str, package: Package) -> ModuleType:
    """Run an example's hooks.py; what it imports from its package is found where it is at home."""

    path = EXAMPLES / name / "hooks.py"
    text = path.read_text(encoding="utf-8") if path.exists() else ""

    homes = exports_of(checked(name).graph, former=False)

    def found(_: str, wanted: Sequence[str]) -> object:
        return SimpleNamespace(**{one: _exported(one, homes[one], package) for one in wanted})

    return in_memory(f"{name}.hooks", compile(text, str(path), "exec"), found)


def _exported(one: str, home: str, package: Package) -> object:
    if home.startswith("._runtime"):
        return getattr(import_module(home.replace("._runtime", "plutoc_runtime")), one)
    return getattr(package.model, one)
