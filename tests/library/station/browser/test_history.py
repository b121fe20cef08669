"""The page History: a flight is watched again as it was, reported, and never taken for the one of now."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.kit.axe import violations
from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import PLAN, put_in
from tests.library.station.browser.steps import open_page

pytestmark = pytest.mark.long

INSTANTS = 5

DRAWN = Path(__file__).with_name("drawn.js").read_text(encoding="utf-8")

SCRUB = """
(slider, time) => {
  slider.value = String(time);
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}
"""


def watched(station: Station, page: Page) -> list[dict[str, Any]]:
    """Watch a flight in the Monitor to its end; return what was drawn at some instants."""
    views: list[dict[str, Any]] = []
    open_page(page, "Monitor")
    station.tell("start")

    def is_over() -> bool:
        views.append(page.evaluate(DRAWN))
        return station.phase == "over"

    until(is_over, "the flight is over")
    views.append(page.evaluate(DRAWN))
    told = [view for view in views if view["missions"]]
    return [*told[:: max(1, len(told) // INSTANTS)], told[-1]]


def replay_of(page: Page) -> Locator:
    """Open the newest flight."""
    open_page(page, "History")
    page.get_by_role("table", name="Flights").locator("tbody").get_by_role("button").first.click()
    slider = page.get_by_role("slider", name="Time")
    expect(slider).to_be_visible()
    return slider


def test_a_replay_draws_at_any_instant_what_the_live_page_drew_then(
    serve: Serve, visit: Visit
) -> None:
    """Scrubbed to in any order; nothing can be commanded there, and the Stops stay."""
    station = put_in(serve("drugs_distribution", "--speed", "20"))
    page = visit(station)
    views = watched(station, page)
    assert len({str(view["missions"]) for view in views}) >= INSTANTS / 2
    slider = replay_of(page)
    expect(page.get_by_role("note")).to_contain_text("Replay of the flight of")
    for view in [*views, *reversed(views[::2])]:
        slider.evaluate(SCRUB, view["time"])
        rows = page.locator(".replay .mission-entry")
        expect(rows).to_have_count(len(view["missions"]))
        mine = page.evaluate(DRAWN)
        assert (mine["missions"], mine["drones"]) == (view["missions"], view["drones"])
    for button in ("Pause mission", "Cancel mission", "Skip", "Retire", "Resume"):
        expect(page.locator(".replay").get_by_role("button", name=button)).to_have_count(0)
    expect(page.get_by_role("group", name="Stop").get_by_role("button")).to_have_count(2)


def test_a_flight_is_played_by_keys_and_reported(serve: Serve, visit: Visit) -> None:
    station = put_in(serve("drugs_distribution", "--speed", "60"))
    page = visit(station)
    open_page(page, "History")
    expect(page.get_by_text("Nothing has been flown yet.")).to_be_visible()
    station.tell("start")
    until(lambda: station.phase == "over", "the flight is over")
    page.reload()
    slider = replay_of(page)
    expect(page.locator(".replay")).to_be_focused()
    page.keyboard.press("ArrowRight")
    expect(slider).to_have_value("5")
    page.keyboard.press("Shift+ArrowRight")
    expect(slider).to_have_value("35")
    page.get_by_role("combobox", name="Speed").select_option("60 ×")
    page.locator(".replay").focus()
    page.keyboard.press("Space")
    expect(page.get_by_role("button", name="Play")).to_be_visible()  # it has come to its end
    assert float(slider.input_value()) > 100
    page.keyboard.press("Home")
    expect(slider).to_have_value("0")
    assert violations(page) == []
    bar = page.get_by_role("tablist", name="Of this flight")
    bar.get_by_role("tab", name="Results").click()
    expect(page.locator("image.heat")).to_have_count(1)
    bar.get_by_role("tab", name="Report").click()
    report = page.get_by_role("article")
    for mission in PLAN:
        expect(report.get_by_role("row").filter(has_text=mission).first).to_contain_text(
            "Completed"
        )
    expect(
        report.get_by_role("img", name=re.compile(r"^Batteries over the flight"))
    ).to_be_visible()


def test_a_rehearsal_is_said_to_be_one_and_has_no_report(serve: Serve, visit: Visit) -> None:
    station = put_in(serve("drugs_distribution"))
    revision = station.get("/api/plan")["revision"]
    asked = {"revision": revision, "missions": None, "runs": 3}
    forecasts: list[dict[str, Any]] = []

    def is_known() -> bool:
        forecasts.append(station.post("/api/preflight", asked)[1])
        return bool(forecasts[-1].get("rehearsal"))

    until(is_known, lambda: f"a rehearsal is there: {forecasts[-1]}")
    page = visit(station, path=f"/#history/{forecasts[-1]['rehearsal']}")
    expect(page.get_by_role("note")).to_contain_text("Rehearsal. This was computed and never flown")
    slider = page.get_by_role("slider", name="Time")
    slider.evaluate(SCRUB, slider.get_attribute("max"))
    for mission in PLAN:
        row = page.locator(".replay .mission-entry").filter(has_text=mission)
        expect(row).to_contain_text("Completed")
    expect(page.get_by_role("tab", name="Report")).to_have_count(0)
    expect(page.get_by_role("button", name="Stop: land now")).to_be_visible()
