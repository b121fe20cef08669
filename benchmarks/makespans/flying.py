"""Flies a plan in virtual time, by an app of each policy."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from itertools import product
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pluto_fleet.app import described
from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.errors import BadInput

from .plans import APP, Plan

if TYPE_CHECKING:
    from pluto_fleet.app import App
    from pluto_fleet.files.fleet import FleetFile
    from pluto_fleet.flight.outcome import SimulationResult
    from pluto_fleet.shared.domain.model import Mission

FOLLOWS = "follow_routes"
"""The hook by which drones fly what was planned for them."""
HOOK = '''"""Drones that fly the routes that were planned for them, and nothing else."""

ROUTES, GIVEN, STRICT = {{}}, set(), True


def {name}(waiting, drones, now):
    """Give each drone what is next on its route: of those that wait, or, strictly, of all."""
    there, pairs = {{one.trip.name: one for one in waiting}}, []
    for drone in drones:
        left = [name for name in ROUTES.get(drone.id, ()) if name not in GIVEN]
        left = left[:1] if STRICT else left
        able = (there[name] for name in left if name in there)
        one = next((one for one in able if drone in one.drones), None)
        if one is not None:
            pairs.append((one, drone))
            mission = [one.trip.name, *(trip.name for trip in one.mission.trips)]
            carried = 2 if one.trip.action == "pick_item" else 1
            GIVEN.update(mission[:1], mission[1:1 + carried])
    return pairs
'''
A_DAY = 86_400.0

Routes = Mapping[str, Sequence[str]]
"""The names of the trips that each drone flies, in order."""


@dataclass(slots=True)
class Apps:
    """The app, compiled for each policy that is asked for."""

    folder: Path
    _apps: dict[str, App] = field(default_factory=dict)

    def of(self, policy: str) -> App:
        """Return the app with this policy; an empty one is the default."""
        if policy not in self._apps:
            self._apps[policy] = self._compiled(policy)
        return self._apps[policy]

    def _compiled(self, policy: str) -> App:
        name = f"makespans_{policy or 'default'}"
        place = self.folder / name
        place.mkdir(parents=True)
        hook = f"\n  policy {policy}\n" if policy == FOLLOWS else ""
        text = APP.format(hook=hook, policy=f"policy: {policy}" if policy else "")
        (place / "app.pluto").write_text(text.replace("app makespans", f"app {name}"))
        if hook:
            (place / "hooks.py").write_text(HOOK.format(name=policy))
        command = [sys.executable, "-m", "plutoc", "compile", "app.pluto", "-o", "package"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, cwd=place)
        sys.path.insert(0, str(place / "package" / "src"))
        return described(import_module(f"{name}.flow").APP)

    def loaded(self, plan: Plan, policy: str, after_trip: str) -> Loaded:
        """Return a plan that is ready to fly."""
        app = self.of(policy)
        files = self.folder / "missions.toml", self.folder / "fleet.toml"
        for file, text in zip(files, (plan.missions, plan.fleet(after_trip)), strict=True):
            file.write_text(text)
        fleet = load_fleet(files[1], app)
        return Loaded(app=app, fleet=fleet, missions=load_missions(files[0], app, fleet.airspace))

    def flown(self, plan: Plan, policy: str, after_trip: str) -> float:
        """Fly a plan, with durations as they are expected, and return its makespan."""
        flown = self.loaded(plan, policy, after_trip).fly()
        if not flown.completed:
            raise SystemExit(f"plan {plan.name} is not flown to its end with {policy}")
        return flown.duration

    def followed(self, plan: Plan, routes: Routes) -> float:
        """Fly routes, and return the makespan; infinite: they cannot be flown to their end."""
        least = inf
        for after_trip, strict in product(("stay", "next"), (True, False)):
            loaded = self.loaded(plan, FOLLOWS, after_trip)
            hooks: Any = import_module(f"makespans_{FOLLOWS}.hooks")
            hooks.ROUTES, hooks.GIVEN, hooks.STRICT = routes, set(), strict
            try:
                flown = loaded.fly()
            except BadInput:  # each waits for another
                continue
            least = min(least, flown.duration if flown.completed else inf)
        return least


@dataclass(frozen=True, slots=True, kw_only=True)
class Loaded:
    """A plan of an app's own classes."""

    app: App
    fleet: FleetFile
    missions: Sequence[Mission[Any]]

    def fly(self) -> SimulationResult:
        """Fly it to its end; its missions are used up by that."""
        return simulate(
            self.app,
            self.missions,
            self.fleet,
            seed=0,
            faults=Faults(),
            until=A_DAY,
            on_event=None,
        )
