"""Flies random apps whose own actions take long, and looks whether a battery is ever run down.

    python -m tests.batteries --apps 400

Each app is compiled: its action says what it takes, by a time or by a parameter, or does not, and its hook takes
as long, a little longer or much longer. What `check` calls possible is flown with traffic and chance. The exit code is 1 if
a drone falls, if one that was called back does not come home, if an action that keeps to what it says does not
complete, or if `size` and `check` do not agree on whether a fleet can do it.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from random import Random

from pluto_fleet.app import App, described
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.files.plan_check import unflyable
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from pluto_fleet.sizing.question import Question
from tests.kit import apps
from tests.kit.campaign import Campaign
from tests.sizing.plans import Plan, sized_plan

SOURCE = """pluto 1
app NAME {{
  category scout(flight_time: {flight_time} s, charge_time: 2 min, reserve: {reserve} %) can look
  action look(span: time = {default} s){takes}
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  retry = PriorityManager(max_attempts: 2)
  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> retry when FAILED
  retry -> allocate when STANDBY
  [watch, retry] -> end otherwise
}}
"""
HOOKS = """async def look(drone, trip, context, *, span):
    await context.sleep({lasts})
"""


@dataclass
class Judged:
    """What has become of one app."""

    was: str
    wrong: list[str] = field(default_factory=list)


def judged(number: int) -> Judged:
    """Compile an app by chance, check it and fly it."""
    chance = Random(f"batteries/{number}")
    flight_time = chance.choice((120, 240, 420))
    reserve = chance.choice((10, 20, 30))
    span = round(chance.uniform(0.02, 1.0) * flight_time, 1)
    default = round(span * chance.choice((1.0, chance.uniform(0.1, 1.0))), 1)
    takes = chance.choice(("", f" takes {span} s", " takes span"))
    honest = takes != "" and chance.random() < 0.6
    lasts = span if honest else round(span * chance.uniform(1.0, 3.0), 1)
    source = SOURCE.format(flight_time=flight_time, reserve=reserve, default=default, takes=takes)
    app = described(apps.loaded(source, HOOKS.format(lasts=lasts)).app)
    missions = [_mission(chance, place, span) for place in range(chance.randint(1, 4))]
    file = _fleet(chance)
    app = moving(app, file.motion)
    possible = not unflyable(missions, app, file, file.airspace)
    found = Judged("kept" if honest else "broken") if possible else Judged("refused")
    if number % 8 == 0 and (honest or not possible):
        plan = Plan(question=Question(app=app, missions=missions), fleet=file)
        answer = sized_plan(plan, confidence=0.9)
        if (answer.found is not None) is not possible:
            found.wrong.append(f"size says otherwise: {answer.found} {answer.causes[:1]}")
    if possible:
        found.wrong += _flown(app, missions, file, number, honest)
    return found


def _flown(
    app: App, missions: Sequence[apps.Mission], file: FleetFile, seed: int, honest: bool
) -> list[str]:
    outcome = apps.fly(app, *missions, on=file, seed=seed, until=86_400.0)
    wrong = [f"{event['drone']} is lost" for event in apps.events(outcome, "drone.lost")]
    for event in apps.events(outcome, "trip.failed"):
        if not str(event["reason"]).startswith("look failed: battery"):
            wrong.append(f"a trip failed: {event['reason']}")
        elif honest:
            wrong.append(f"an action that keeps to what it says was cancelled: {event['reason']}")
    for name, drone in outcome.standing["drones"].items():
        if drone["status"] not in ("FREE", "CHARGING"):
            wrong.append(f"{name} is {drone['status']} in the end")
    if outcome.given_up:
        wrong.append(f"given up: {outcome.given_up}")
    return wrong


def _mission(chance: Random, place: int, span: float) -> apps.Mission:
    trips = []
    for name in "AB"[: chance.randint(1, 2)]:
        x, y = (round(chance.uniform(1.5, 11.0), 1) for _ in "xy")
        trips.append(apps.trip(name, x, y, "look", parameters={"span": span}))
    return apps.mission(f"M{place}", *trips, index=place)


def _fleet(chance: Random) -> FleetFile:
    homes = [(1.0 + place, 0.8, 0.0) for place in range(chance.randint(1, 4))]
    return replace(
        apps.fleet(*homes),
        airspace=Airspace(size=(12.0, 12.0)),
        apart=chance.choice((0.0, 0.5)),
        motion=replace(CRAZYFLIE, spread=chance.choice((0.0, 0.01, 0.05))),
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign."""
    campaign = Campaign("tests.batteries", __doc__)
    campaign.draws("apps", 400)
    campaign.parse(arguments)
    came = Counter[str]()
    for number, one in campaign.each(judged, campaign.numbers):
        came[one.was] += 1
        if one.wrong:
            campaign.found(f"app {number}", *one.wrong)
    return campaign.over(", ".join(f"{many} {was}" for was, many in sorted(came.items())))


if __name__ == "__main__":
    sys.exit(main())
