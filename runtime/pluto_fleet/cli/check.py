"""`check`: the plan against the app and the fleet."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plutoc_runtime import output
from plutoc_runtime.domain.text import counted

from ..files.fleet import too_fast
from ..files.plan_check import idle_actions
from .plans import load

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App

    from .options import Options


def check(app: App, options: Options) -> int:
    """Say that the fleet can fly the missions; where it cannot, loading has said why."""
    plan = load(app, options)
    for sentence in [*too_fast(app, plan.fleet), *idle_actions(app, plan.fleet)]:
        output.tell(f"{options.fleet or app.name}: warning: {sentence}")
    trips = sum(len(mission.trips) for mission in plan.missions)
    missions, drones = len(plan.missions), len(plan.fleet.drones)
    output.line(
        f"{counted(missions, 'mission')} with {counted(trips, 'trip')}: "
        f"a fleet of {counted(drones, 'drone')} can fly them"
    )
    return 0
