"""A station shows what its own app's graph needs, and an empty one says what to do."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tests.kit.station import until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.steps import (
    add_mission,
    card_of,
    drag,
    labels,
    missions_listed,
    open_page,
    sees_all,
    start,
)

pytestmark = pytest.mark.long


def test_the_example_plan_of_an_app_is_sound_and_flies_to_its_end(
    serve: Serve, visit: Visit
) -> None:
    station = serve("pm10", "--speed", "80")
    page = visit(station)
    page.get_by_role("button", name="Use the example plan").click()
    expect(missions_listed(page).first).to_be_visible()
    plan = station.get("/api/plan")
    assert plan["problems"] == []
    names = tuple(mission["name"] for mission in plan["missions"])
    assert len(names) >= 2
    start(page)
    sees_all(page, "Completed", names)
    until(lambda: station.phase == "over", "all have ended")


def test_going_to_the_trips_first_is_answered_by_select_a_mission(
    serve: Serve, visit: Visit
) -> None:
    """The thesis's testers got lost just here."""
    page = visit(serve("drugs_distribution"))
    open_page(page, "Trips")
    trips = page.get_by_role("tabpanel", name="Trips")
    first = trips.get_by_role("region", name="What to do first")
    expect(first).to_contain_text("mission")
    first.get_by_role("button", name="New mission").click()
    expect(first).to_be_hidden()
    open_page(page, "Monitor")
    expect(page.get_by_role("tabpanel", name="Monitor")).to_contain_text("mission")


def fields(page: Page) -> tuple[set[str], set[str]]:
    """Draw a mission with one trip; return what can be filled in of both."""
    add_mission(page, "Look")
    drag(page, "measure", (3.0, 5.0))
    expect(card_of(page, 1).get_by_label("Name")).to_be_visible()
    trip = labels(page)
    open_page(page, "Missions")
    expect(page.get_by_role("button", name="Set trips")).to_be_visible()
    mission = labels(page)
    return mission, trip


def test_an_app_shows_the_fields_that_its_graph_needs_and_no_other(
    serve: Serve, visit: Visit
) -> None:
    mission, trip = fields(visit(serve("drugs_distribution")))
    assert mission == {"Name"}
    names = {"Mission", "Name of the mission"}
    assert trip == {*names, "Name", "x (m)", "y (m)", "Height (m)", "Quantity"}
    mission, trip = fields(visit(serve("alfalfa")))
    assert mission >= {"Name", "Safe time", "Repeat", "Evaluator", "Start at", "Repeat every"}
    assert trip >= {"Delay", "Priority"}
