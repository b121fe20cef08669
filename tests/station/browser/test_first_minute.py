"""An empty station says what to do, and draws an example that its own app and fleet can fly."""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from tests.station.browser.conftest import APPS, Serve, Visit
from tests.station.browser.serving import until
from tests.station.browser.steps import missions_listed, open_page, sees_all, start


@pytest.mark.parametrize("app", APPS)
def test_the_example_plan_of_every_app_is_sound_and_flies_to_its_end(
    serve: Serve, visit: Visit, app: str
) -> None:
    station = serve(app, "--speed", "40")
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
