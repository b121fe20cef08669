"""What is typed and cannot be in the plan stays, marked; and who leads to it, and who is told."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.kit.browser import Watch
from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Visit
from tests.library.station.browser.steps import (
    ANOTHER_WAS_QUICKER,
    card_of,
    holding_the_first,
    open_page,
    select_mission,
)


def opened(page: Page, mission: str, trip: int) -> Locator:
    """Open a trip's card."""
    open_page(page, "Missions")
    select_mission(page, mission)
    open_page(page, "Trips")
    card = card_of(page, trip)
    card.locator(".trip-head").click()
    return card


def target(station: Station, mission: int, trip: int) -> list[float]:
    missions: list[dict[str, Any]] = station.missions
    found: list[float] = missions[mission]["trips"][trip]["target"]
    return found


def told(page: Page) -> Locator:
    """Return what stands beside Start."""
    return page.locator(".why")


@pytest.mark.parametrize(
    "wrong", ["abc", *(pytest.param(one, marks=pytest.mark.long) for one in ("", "1e300"))]
)
def test_a_wrong_coordinate_is_marked_and_start_waits_for_it(
    planned: Station, visit: Visit, wrong: str
) -> None:
    """What was typed stays, the plan's own value is told, and the reason leads to the field."""
    page = visit(planned)
    x = opened(page, "Mission 2", 1).get_by_label("x (m)")
    x.fill(wrong)
    x.press("Tab")
    page.get_by_role("button", name="Zoom in").click()  # it is drawn anew
    expect(x).to_have_value(wrong)
    expect(x).to_have_attribute("aria-invalid", "true")
    said = "Write metres here, such as 2.5. The plan still has 9."
    expect(x).to_have_accessible_description(said)
    start = page.get_by_role("button", name="Start 3 missions")
    expect(start).to_have_attribute("aria-disabled", "true")
    expect(told(page)).to_have_text(f"Mission 2, trip 1: {said}")
    assert target(planned, 1, 0) == [9.0, 1.5]
    opened(page, "Mission 1", 1)
    open_page(page, "Monitor")
    told(page).get_by_role("button", name="Mission 2, trip 1").click()
    x = card_of(page, 1).get_by_label("x (m)")
    expect(x).to_be_focused()
    expect(x).to_have_value(wrong)
    x.fill("8,5")
    expect(start).not_to_have_attribute("aria-disabled", "true")
    expect(x).not_to_have_attribute("aria-invalid", "true")
    until(lambda: target(planned, 1, 0) == [8.5, 1.5], "it is in the plan")


@pytest.mark.long
def test_two_who_name_one_mission_at_once_are_told_and_nothing_is_lost(
    planned: Station, visit: Visit, watch: Watch
) -> None:
    watch.expected.append(ANOTHER_WAS_QUICKER)
    one, other = visit(planned), visit(planned)
    held = holding_the_first(other)
    for page in (one, other):
        select_mission(page, "Mission 2")
    with other.expect_request(lambda request: request.method == "PUT"):
        other.get_by_role("textbox", name="Name").fill("Beta")
    name = one.get_by_role("textbox", name="Name")
    name.fill("Alpha")
    until(lambda: planned.missions[1]["name"] == "Alpha", "it is kept")
    held[0].continue_()
    other.unroute("**/api/plan")
    expect(other.locator(".notices [role=alert]")).to_contain_text(
        "Another page wrote “Alpha” while you wrote “Beta” there. The plan has yours now."
    )
    until(lambda: planned.missions[1]["name"] == "Beta", "it is kept")
    expect(name).to_have_value("Alpha")
    expect(name).to_have_accessible_description(re.compile("changed this to “Beta”"))
    name.press("Tab")
    expect(name).to_have_value("Beta")
