"""One flight after another, and what one can do about those that fly or were stopped."""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from tests.kit.station import until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import COMPLETED, put_in
from tests.library.station.browser.steps import (
    add_mission,
    drag,
    missions_listed,
    open_page,
    row_of,
    sees_all,
    start,
)

pytestmark = pytest.mark.long


def test_a_mission_that_is_drawn_while_others_fly_is_started_beside_them(
    serve: Serve, visit: Visit
) -> None:
    station = put_in(serve("drugs_distribution"))
    page = visit(station)
    start(page)
    expect(row_of(page, "Mission 1")).to_be_visible()  # it leads to the Monitor
    add_mission(page, "Late")
    drag(page, "take_photo", (3.0, 5.0))
    expect(page.get_by_role("button", name="Start 1 new mission")).to_be_visible()
    start(page)
    sees_all(page, "Completed", (*COMPLETED, "Late"))
    assert station.statuses() == {**COMPLETED, "Late": "COMPLETED"}
    assert len(station.journals()) == 1


def test_what_was_stopped_is_put_away_and_the_plan_begins_anew(serve: Serve, visit: Visit) -> None:
    """Its missions can be changed again."""
    station = put_in(serve("drugs_distribution"))
    page = visit(station)
    start(page)
    until(lambda: station.phase == "flying", "it flies")
    page.get_by_role("button", name="Stop: land now").click()
    page.get_by_role("button", name="Put away").click()
    until(lambda: station.phase == "idle", "it is put away")
    open_page(page, "Missions")
    missions_listed(page).first.click()
    page.get_by_role("button", name="Delete").click()
    expect(missions_listed(page)).to_have_count(2)
    start(page)
    sees_all(page, "Completed", ("Mission 2", "Mission 3"))
