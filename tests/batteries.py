"""Flies apps whose own actions last as long as is drawn, and sees that no battery runs out of it.

    python -m tests.batteries --apps 400

An action says how long it takes, by itself or by a parameter of the trip, and takes that, less, or up to ten
times as much. Nothing falls; what `check` calls possible is completed where actions take what they say; what is cancelled for its battery fails its trip, and its drone comes home; and a fleet is
found by `size` just where `check` calls it possible.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence
from random import Random
from typing import Any, NamedTuple, cast

from pluto_fleet.app import App
from pluto_fleet.files.plan_check import unflyable
from pluto_fleet.shared.alone.simulate import simulate as simulate_alone
from pluto_fleet.shared.domain.actions import Parameter
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.domain.quantities import Type
from pluto_fleet.shared.domain.status import DroneStatus, Status
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.sizing.answer import sized
from pluto_fleet.sizing.bounds import Rule
from pluto_fleet.sizing.fleets import Stock
from pluto_fleet.sizing.question import Question
from tests.kit import apps
from tests.kit.campaign import Campaign

SPARED = 0.5
"""The share of a reserve that must be left, but where drones that were all called home wait for one another."""


class Drawn(NamedTuple):
    """An app, its missions and its fleet, and how much longer than it says an action takes."""

    app: App
    missions: list[apps.Mission]
    fleet: Any
    longer: float


def drawn(number: int) -> Drawn:
    """Draw one."""
    chance = Random(f"batteries/{number}")
    reserve, minutes = chance.choice((0.1, 0.2, 0.3)), chance.choice((3.0, 4.0, 7.0))
    scout = Category(name="scout", flight_time=60 * minutes, charge_time=300.0, reserve=reserve)
    span = round(chance.uniform(0.05, 1.1) * scout.flight_time, 1)
    longer = chance.choice((0.5, 1.0, 1.0, 1.0, 1.3, 2.0, 10.0))

    async def look(drone: Any, trip: Any, context: Any, **given: float) -> None:
        await context.sleep(longer * given.get("span", span))

    if chance.random() < 0.5:
        parameters = (Parameter(name="span", type=Type.TIME),)
        action = OwnAction(name="look", parameters=parameters, takes="span", hook=look)
        given = {"span": span}
    else:
        action = OwnAction(name="look", takes=span, hook=look)
        given = {}
    missions = [
        apps.mission(
            f"M{place}",
            *(
                apps.trip(
                    str(n), chance.uniform(2, 15), chance.uniform(1, 9), "look", parameters=given
                )
                for n in range(chance.randint(1, 2))
            ),
            index=place,
        )
        for place in range(chance.randint(1, 3))
    ]
    homes = [(1.0 + place, 0.8, 0.0) for place in range(chance.randint(1, 3))]
    fleet = apps.fleet(*homes, apart=chance.choice((0.0, 0.5)))
    app = apps.app(apps.flow(attempts=2), categories=[scout], actions=[action])
    return Drawn(moving(app, fleet.motion), missions, fleet, longer)


def one_app(number: int) -> tuple[list[str], Counter[str]]:
    """Fly one app alone and with the library; return what must not be, and what came of it."""
    app, missions, fleet, longer = drawn(number)
    possible = not unflyable(missions, app, fleet, fleet.airspace)
    came, wrong = Counter({"possible": int(possible)}), list[str]()
    if longer == 1.0:
        rule = Rule(confidence=0.8, runs=20)
        stock = Stock(fleet=fleet, missions=missions, most=4)
        size = sized(
            Question(app=app, missions=missions),
            stock,
            rule,
            seed=number,
            jobs=1,
            watch=lambda _: None,
        )
        came["sized"] += 1
        most = stock.largest  # its docks may be nearer than those of the fleet
        if (size.found is None) is not bool(unflyable(missions, app, most, most.airspace)):
            wrong.append(f"check says otherwise than size: {size.causes or size.found}")
    if possible:
        flights = {"library": apps.fly(app, *drawn(number).missions, on=fleet, seed=number)}
        alone = simulate_alone(
            cast(Any, app.given),
            drawn(number).missions,
            fleet,
            seed=number,
            faults=apps.NO_FAULTS,
            until=None,
            on_event=None,
        )
        for name, flown in {**flights, "alone": alone}.items():
            spared = 0.0 if fleet.apart and longer > 1.0 else SPARED * app.categories[0].reserve
            wrong += [
                f"{name}: {one}"
                for one in _wrong(flown, app.categories[0].reserve, spared, longer, came)
            ]
    return wrong, came


def _wrong(
    flown: Any, reserve: float, spared: float, longer: float, came: Counter[str]
) -> list[str]:
    events: Sequence[Event] = flown.events
    failed = [one for one in events if one["event"] == "trip.failed"]
    cancelled = [one for one in failed if "battery" in str(one["reason"])]
    wrong = [f"fails: {one}" for one in failed if one not in cancelled]
    stand = flown.standing
    wrong += [
        f"{name} is {one['status']} with {one['battery']}"
        for name, one in stand["drones"].items()
        if one["status"] == DroneStatus.LOST.value or one["battery"] <= 0.0
    ]
    if longer <= 1.0:
        ends = [
            one for one in stand["missions"].values() if one["status"] != Status.COMPLETED.value
        ]
        wrong += [f"not completed: {one['reason']}" for one in ends]
    least = min((float(str(one["battery"])) for one in events if "battery" in one), default=1.0)
    if least < spared:
        wrong.append(f"{least:.1%} left of a reserve of {reserve:.0%}")
    came["cancelled"] += len(cancelled)
    came["flights"] += 1
    came["reserve broken"] += least < reserve
    return wrong


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign."""
    campaign = Campaign("tests.batteries", __doc__)
    campaign.draws("apps", 400)
    campaign.parse(arguments)
    whole = Counter[str]()
    for number, (wrong, came) in campaign.each(one_app, campaign.numbers):
        whole.update(came)
        if wrong:
            campaign.found(f"app {number}", *wrong)
    return campaign.over(", ".join(f"{count} {what}" for what, count in sorted(whole.items())))


if __name__ == "__main__":
    sys.exit(main())
