"""A station shows the fields and columns of its own app's graph, and no others."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from tests.station.browser.conftest import Serve, Visit
from tests.station.browser.steps import (
    add_mission,
    card_of,
    drag,
    labels,
    open_page,
    row_of,
    start,
)


def fields(page: Page) -> tuple[set[str], set[str], set[str]]:
    """Draw a mission with one trip and start it; return what can be filled in, and the columns."""
    add_mission(page, "Look")
    drag(page, "measure", (3.0, 5.0))
    expect(card_of(page, 1).get_by_label("Name")).to_be_visible()
    trip = labels(page)
    open_page(page, "Missions")
    expect(page.get_by_role("button", name="Set trips")).to_be_visible()
    mission = labels(page)
    start(page)
    expect(row_of(page, "Look")).to_be_visible()
    return mission, trip, set(page.get_by_role("columnheader").all_inner_texts())


def test_an_app_without_clock_repeater_timer_or_priorities_shows_none_of_their_fields(
    serve: Serve, visit: Visit
) -> None:
    mission, trip, columns = fields(visit(serve("drugs_distribution")))
    assert mission == {"Name"}
    assert trip == {"Mission", "Name", "x (m)", "y (m)", "Height (m)", "Quantity"}
    assert columns == {"Mission", "State", "Trip", "Drone"}


def test_an_app_with_all_of_them_shows_all_of_their_fields(serve: Serve, visit: Visit) -> None:
    mission, trip, columns = fields(visit(serve("alfalfa")))
    assert mission >= {"Name", "Safe time", "Repeat", "Evaluator", "Start at", "Repeat every"}
    assert trip >= {"Delay", "Priority"}
    assert columns >= {"Attempt", "Round"}


def test_what_is_not_needed_is_not_in_what_the_station_says_of_its_app(serve: Serve) -> None:
    """Nor is there any evaluator to choose, nor an action that no drone can do."""
    app = serve("drugs_distribution").get("/api/app")
    assert app["fields"] == {"mission": [], "trip": []}
    assert app["evaluators"] == []
    assert {action["name"] for action in app["actions"]} == {
        "pick_item",
        "release_item",
        "take_photo",
        "measure",
    }
    assert not app["retries"]
    assert not app["rounds"]
