"""The page Results draws what was brought, and nothing else: heat, photos, findings, the table."""

from __future__ import annotations

import re
from typing import Any

from playwright.sync_api import Locator, Page, expect

from tests.kit.axe import violations
from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import put_in
from tests.library.station.browser.steps import open_page
from tests.paths import EXAMPLES

DRAINED = """
async (drained) => {
  const { world } = await import("/pages/core/station.js");
  world.results.amend([{ ...world.results.entries.peek()[0], drained }]);
}
"""

MANY = """
async (count) => {
  const { world } = await import("/pages/core/station.js");
  const [first] = world.results.entries.peek();
  world.results.replace(Array.from({ length: count }, (_, at) => ({ ...first, number: at + 1, time: at })));
}
"""


def fly(station: Station) -> None:
    """Fly the station's missions to their end."""
    station.tell("start")
    until(lambda: station.phase == "over", "the flight is over")


def flown(serve: Serve, visit: Visit, app: str) -> tuple[Page, list[dict[str, Any]]]:
    """Fly an example's own missions, and look at what they brought."""
    missions = ("--missions", str(EXAMPLES / app / "missions.toml"))
    station = serve(app, *missions, "--speed", "60")
    fly(station)
    page = visit(station)
    open_page(page, "Results")
    return page, station.get("/api/results.json")


def rows_of(page: Page) -> Locator:
    return page.get_by_role("table", name="Results").locator(".virtual-rows").get_by_role("row")


def test_results_are_searched_filtered_sorted_and_shown_on_the_map(
    serve: Serve, visit: Visit
) -> None:
    station = put_in(serve("drugs_distribution", "--speed", "60"))
    page = visit(station)
    open_page(page, "Results")
    expect(page.get_by_text("Nothing has been flown yet: start a mission.")).to_be_visible()
    fly(station)
    results = station.get("/api/results.json")
    page.get_by_role("tab", name="Table").click()
    rows = rows_of(page)
    expect(rows).to_have_count(len(results))
    page.get_by_label("Search the results").fill("temperature")
    expect(rows).to_have_count(3)
    page.get_by_role("combobox", name="All missions").select_option("Mission 2")
    expect(rows).to_have_count(2)
    page.get_by_role("button", name="Show all").click()
    page.get_by_role("combobox", name="All kinds").select_option("Temperature")
    measured = sorted(one["value"] for one in results if one["kind"] == "measurement")
    page.get_by_role("button", name="Value").click()
    column = page.get_by_role("columnheader", name="Value")
    expect(column).to_have_attribute("aria-sort", "ascending")
    shown = rows.locator(".cell.of-value").all_inner_texts()
    assert shown == [f"{value:.6g} °C" for value in measured]
    rows.first.click()
    card = page.get_by_role("region", name="Temperature")
    expect(card).to_contain_text(re.compile(r"Place.*When.*Mission.*Drone", re.DOTALL))
    page.keyboard.press("ArrowDown")
    expect(card).to_contain_text(f"{measured[1]:.6g} °C")
    assert violations(page) == []
    page.evaluate(DRAINED, 0.07)
    page.get_by_role("button", name="Show all").click()
    page.get_by_label("Search the results").fill("reserve")
    expect(rows).to_have_count(1)
    sentence = "came home from this trip with 7%, less than its reserve"
    expect(rows.get_by_role("button", name=sentence)).to_be_visible()
    rows.first.click()
    card = page.locator(".result-card")
    expect(card).to_contain_text(sentence)
    assert violations(page) == []
    card.get_by_role("button", name="Show in console").click()
    expect(page.get_by_role("tab", name="Monitor")).to_have_attribute("aria-selected", "true")
    open_page(page, "Results")
    page.get_by_role("tab", name="Layers").click()
    page.get_by_role("checkbox", name="Temperature").uncheck()
    expect(page.locator("image.heat")).to_have_count(0)
    page.reload()
    expect(page.get_by_role("checkbox", name="Temperature")).not_to_be_checked()
    page.get_by_role("tab", name="Table").click()
    page.evaluate(MANY, 5000)
    expect(page.get_by_text("5,000 of 5,000 results")).to_be_visible()
    assert rows.count() < 60
