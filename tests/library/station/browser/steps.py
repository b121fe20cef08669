"""What a person does in the page, a function each, found as a person finds it: by what it says."""

from __future__ import annotations

import re

from playwright.sync_api import Locator, Page, Route, expect
from playwright.sync_api import TimeoutError as NotInTime

from tests.library.station.browser.exercise import PLAN, Place

A_FLIGHT = 120_000
"""Milliseconds until a flight that does not end is called a failure."""

START = re.compile(r"^Start \d+ (new )?missions?$")

ADD_MISSION = re.compile("^Add (the first )?mission$")

ANOTHER_WAS_QUICKER = "409 (Conflict)"
"""A page that is told so draws on top of that; a browser calls the answer an error."""

DRAWN = "() => new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn)))"

PLACE_ON_THE_SCREEN = """
([x, y]) => {
  const world = document.querySelector(".page:not([hidden]) svg.floor-picture g.world");
  const place = new DOMPoint(x, y).matrixTransform(world.getScreenCTM());
  return [place.x, place.y];
}
"""


def settled(page: Page) -> None:
    """Wait until what has changed is laid out and drawn."""
    page.evaluate(DRAWN)


def open_page(page: Page, name: str) -> None:
    """Go to one of the pages."""
    page.get_by_role("tablist", name="Pages").get_by_role("tab", name=name).click()


def add_mission(page: Page, name: str) -> None:
    """Add a mission, type its name over the one that it has, and go on to its trips."""
    open_page(page, "Missions")
    page.get_by_role("button", name=ADD_MISSION).click()
    page.keyboard.type(name)
    page.get_by_role("button", name="Set trips").click()


def on_the_screen(page: Page, place: Place) -> tuple[float, float]:
    """Return the pixel at which a place on the floor plan is seen."""
    settled(page)
    x, y = page.evaluate(PLACE_ON_THE_SCREEN, list(place))
    return x, y


def action_called(page: Page, name: str) -> Locator:
    """Return an action of the list beside the map: `take_photo` is "Take photo"."""
    said = name.replace("_", " ").capitalize()
    group = page.get_by_role("group", name="Actions to put on the map")
    return group.get_by_role("button", name=said, exact=True)


def drag(page: Page, action: str, place: Place) -> None:
    """Drag an action onto the map with a mouse, as a hand does: press, move, let go."""
    box = action_called(page, action).bounding_box()
    assert box is not None
    x, y = on_the_screen(page, place)
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(x - 30, y + 20, steps=4)
    page.mouse.move(x, y, steps=4)
    page.mouse.up()


def card_of(page: Page, trip: int) -> Locator:
    """Return the card of the trip with this number."""
    return page.get_by_role("list", name="Trips").get_by_role("listitem").nth(trip - 1)


def start(page: Page, button: str | re.Pattern[str] = START) -> None:
    """Hold Start down, as soon as it says how many missions it will start."""
    held = page.get_by_role("button", name=button)
    for again in (True, False):
        expect(held).not_to_have_attribute("aria-disabled", "true")
        held.hover()
        try:
            with page.expect_request("**/api/start", timeout=10_000):
                page.mouse.down()
            return
        except NotInTime:  # what came in above it has moved it away: a person presses again
            if not again:
                raise
        finally:
            page.mouse.up()


def row_of(page: Page, mission: str) -> Locator:
    """Return a mission's entry in the Monitor."""
    entries = page.get_by_role("tabpanel", name="Monitor").locator("[data-mission]")
    return entries.filter(has=page.get_by_text(mission, exact=True))


def sees_all(page: Page, word: str, missions: tuple[str, ...] = tuple(PLAN)) -> None:
    """Watch the Monitor until it says so of each of the missions."""
    for mission in missions:
        stands = row_of(page, mission).locator(".opener .standing-word")
        expect(stands).to_have_text(word, timeout=A_FLIGHT)


def pin_of(page: Page, trip: int) -> Locator:
    """Return the pin of the trip with this number."""
    return page.get_by_role("button", name=re.compile(f"^Trip {trip}: "))


def missions_listed(page: Page) -> Locator:
    """Return the names in the list of missions."""
    return page.get_by_role("listbox", name="Missions").get_by_role("option").locator("strong")


def select_mission(page: Page, name: str) -> None:
    """Press a mission in the list."""
    missions_listed(page).filter(has_text=re.compile(f"^{re.escape(name)}$")).click()


def new_mission(page: Page, name: str) -> None:
    """Make a mission on the page of the trips, and type its name over the one that it has."""
    page.get_by_role("button", name="New mission").first.click()
    expect(page.get_by_label("Name of the mission")).to_be_focused()
    page.keyboard.type(name)


def labels(page: Page) -> set[str]:
    """Return what the fields that are seen are called."""
    panel = page.get_by_role("tabpanel")
    return {text.strip() for text in panel.locator("label:visible").all_inner_texts()}


def holding_the_first(page: Page) -> list[Route]:
    """Keep the first change of the plan that is sent on its way, until the test lets it go on."""
    held: list[Route] = []

    def hold(route: Route) -> None:
        if held or route.request.method != "PUT":
            route.fallback()
        else:
            held.append(route)

    page.route("**/api/plan", hold)
    return held
