"""The page Results draws what was brought, and nothing else: heat, photos, findings, the table."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from random import Random
from typing import Any

from playwright.sync_api import Locator, Page, expect

from pluto_fleet.station.results.heat import heat_at, newest
from pluto_fleet.station.results.mosaic import on_top
from tests.kit.station import Station, until
from tests.library.station.browser.axe import violations
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import put_in
from tests.library.station.browser.steps import open_page, settled
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"
PLACES = 100
REACH, HIGH = 3.2, 100.0
"""What the app pm10 says of its heat map."""

PIXELS = """
async (places) => {
  const image = document.querySelector(".page:not([hidden]) image.heat");
  const drawn = new Image();
  drawn.src = image.getAttribute("href");
  await drawn.decode();
  const { width, height } = drawn;
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  const brush = canvas.getContext("2d");
  brush.drawImage(drawn, 0, 0);
  const { data } = brush.getImageData(0, 0, width, height);
  const [across, up] = ["width", "height"].map((name) => Number(image.getAttribute(name)));
  return places.map(([x, y]) => {
    const column = Math.min(width - 1, Math.floor((x / across) * width));
    const row = Math.min(height - 1, Math.floor((1 - y / up) * height));
    const begin = (row * width + column) * 4;
    return {
      middle: [((column + 0.5) * across) / width, up - ((row + 0.5) * up) / height],
      pixel: [...data.slice(begin, begin + 4)],
    };
  });
}
"""
"""The pixels of a heat map at places, and what places are in their middles."""

COLOURS = """
async ([values, range]) => {
  const { colourAt, shareOf } = await import("/pages/results/colours.js");
  return values.map((value) => value === null ? [0, 0, 0, 0] : [...colourAt(shareOf(value, range)), 255]);
}
"""

MANY = """
async (count) => {
  const { world } = await import("/pages/core/station.js");
  const [first] = world.results.entries.peek();
  world.results.replace(Array.from({ length: count }, (_, at) => ({ ...first, number: at + 1, time: at })));
}
"""


def flown(serve: Serve, app: str) -> Station:
    """Fly an example's own missions to their end."""
    missions = ("--missions", str(EXAMPLES / app / "missions.toml"))
    station = serve(app, *missions, "--speed", "60")
    station.tell("start")
    until(lambda: station.phase == "over", "the flight is over")
    return station


def results_of(station: Station) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = station.get("/api/results.json")
    assert found
    return found


def somewhere(size: Sequence[float]) -> list[list[float]]:
    """Return random places, the same in every run."""
    chance = Random("places")
    return [[chance.uniform(0, along) for along in size] for _ in range(PLACES)]


def rows_of(page: Page) -> Locator:
    return page.get_by_role("table", name="Results").locator(".virtual-rows").get_by_role("row")


def test_the_heat_map_has_the_colours_of_the_formula_and_is_blank_where_nothing_is_known(
    serve: Serve, visit: Visit
) -> None:
    station = flown(serve, "pm10")
    page = visit(station)
    open_page(page, "Results")
    expect(page.locator("image.heat")).to_have_count(1)
    found = [one for one in results_of(station) if one["kind"] == "measurement"]
    samples = newest((*(one["at"] or one["target"])[:2], one["value"]) for one in found)
    low = min(one["value"] for one in found)
    size = station.get("/api/app")["map"]["size"]
    drawn = page.evaluate(PIXELS, somewhere(size))
    values = [heat_at(samples, one["middle"][0], one["middle"][1], REACH) for one in drawn]
    wanted = page.evaluate(COLOURS, [values, {"low": low, "high": HIGH}])
    for one, colour in zip(drawn, wanted, strict=True):
        apart = max(abs(a - b) for a, b in zip(one["pixel"], colour, strict=True))
        assert apart <= 1, (one, colour)  # a byte, where a rounding of the last digit decides
    page.get_by_role("button", name="Hide the lists").click()  # which have the same
    legend = page.get_by_role("region", name="Legend")
    expect(legend).to_contain_text("PM10")
    expect(legend).to_contain_text(f"{low:.3g} µg/m³100 µg/m³")
    page.get_by_role("button", name="Show the lists").click()
    dots = page.locator(".value circle")
    expect(dots).to_have_count(len(samples))
    held = dots.evaluate_all("(all) => all.map((one) => Number(one.dataset.value))")
    assert sorted(held) == sorted(value for _, _, value in samples)


def test_pins_count_what_the_newest_photo_of_a_place_shows(serve: Serve, visit: Visit) -> None:
    station = flown(serve, "alfalfa")
    page = visit(station)
    open_page(page, "Results")
    counts: dict[tuple[str, float, float], int] = {}
    for one in results_of(station):
        x, y = (one["target"] or [0, 0])[:2]
        for tag in set(one["tags"]):
            counts[tag, x, y] = one["tags"].count(tag)
    assert counts
    pins = page.locator(".finding [data-tag]")
    expect(pins).to_have_count(len(counts))
    written = pins.evaluate_all("(all) => all.map((one) => [one.dataset.tag, one.textContent])")
    as_written = [
        [tag, str(count) if count > 1 else tag[0].upper()] for (tag, _, _), count in counts.items()
    ]
    assert sorted(written) == sorted(as_written)
    page.get_by_role("button", name="bloom").click()  # from the layer to its results
    expect(page.get_by_role("tab", name="Table")).to_have_attribute("aria-selected", "true")
    blooms = [one for one in results_of(station) if "bloom" in one["tags"]]
    expect(rows_of(page)).to_have_count(len(blooms))


def test_photos_lie_where_they_were_taken_the_sharpest_on_top(serve: Serve, visit: Visit) -> None:
    station = flown(serve, "aerial_mapping")
    page = visit(station)
    open_page(page, "Results")
    photos = [
        (one["number"], one["value"]) for one in results_of(station) if one["kind"] == "photo"
    ]
    prints = page.locator(".footprint:not(.chosen)")
    expect(prints).to_have_count(len(photos))
    drawn = prints.evaluate_all(
        "(all) => all.map((one) => [Number(one.dataset.result),"
        " ...['x', 'y', 'width', 'height'].map((name) => Number(one.getAttribute(name)))])"
    )
    for x, y in somewhere(station.get("/api/app")["map"]["size"]):
        there = [
            number
            for number, left, low, width, height in drawn
            if left <= x <= left + width and low <= y <= low + height
        ]
        assert (there[-1] if there else None) == on_top(photos, x, y)
    page.get_by_role("tab", name="Photos").click()
    page.get_by_role("tabpanel", name="Photos").get_by_role("button").first.click()
    viewer = page.get_by_role("dialog")
    expect(viewer).to_contain_text(f"Photo {len(photos)} of {len(photos)}")
    page.keyboard.press("ArrowLeft")
    expect(viewer).to_contain_text(f"Photo {len(photos) - 1} of {len(photos)}")
    expect(viewer).to_contain_text("The camera left no picture of this photo.")
    page.keyboard.press("Escape")
    expect(viewer).to_have_count(0)


def test_results_are_searched_filtered_sorted_and_shown_on_the_map(
    serve: Serve, visit: Visit
) -> None:
    station = put_in(serve("drugs_distribution", "--speed", "60"))
    page = visit(station)
    open_page(page, "Results")
    empty = page.get_by_text("Nothing has been flown yet: start a mission.")
    expect(empty).to_be_visible()
    station.tell("start")
    until(lambda: station.phase == "over", "the flight is over")
    page.get_by_role("tab", name="Table").click()
    rows = rows_of(page)
    expect(rows).to_have_count(len(results_of(station)))
    page.get_by_label("Search the results").fill("temperature")
    expect(rows).to_have_count(3)
    page.get_by_role("combobox", name="All missions").select_option("Mission 2")
    expect(rows).to_have_count(2)
    page.get_by_role("button", name="Show all").click()
    page.get_by_role("combobox", name="All kinds").select_option("Temperature")
    measured = sorted(one["value"] for one in results_of(station) if one["kind"] == "measurement")
    page.get_by_role("button", name="Value").click()
    expect(page.get_by_role("columnheader", name="Value")).to_have_attribute(
        "aria-sort", "ascending"
    )
    shown = rows.locator(".cell.of-value").all_inner_texts()
    assert shown == [f"{value:.6g} °C" for value in measured]
    rows.first.click()
    card = page.get_by_role("region", name="Temperature")
    expect(card).to_contain_text(re.compile(r"Place.*When.*Mission.*Drone", re.DOTALL))
    page.keyboard.press("ArrowDown")
    expect(card).to_contain_text(f"{measured[1]:.6g} °C")
    assert violations(page) == []
    card.get_by_role("button", name="Show in console").click()
    expect(page.get_by_role("tab", name="Monitor")).to_have_attribute("aria-selected", "true")
    open_page(page, "Results")
    page.get_by_role("tab", name="Layers").click()
    page.get_by_role("checkbox", name="Temperature").uncheck()
    expect(page.locator("image.heat")).to_have_count(0)
    page.reload()
    expect(page.get_by_role("checkbox", name="Temperature")).not_to_be_checked()
    assert violations(page) == []
    page.get_by_role("tab", name="Table").click()
    page.evaluate(MANY, 5000)
    expect(page.get_by_text("5,000 of 5,000 results")).to_be_visible()
    assert rows.count() < 60


def test_a_number_of_many_digits_is_shown_as_it_is(serve: Serve, visit: Visit) -> None:
    """And what an app's own action returned is there with its parameters."""
    station = serve("drugs_distribution", "--speed", "60", own=True)
    station.end()
    fleet = station.folder / "fleet.toml"
    text = station.app.fleet.read_text().replace("temperature = 21.5", "temperature = 12345.0")
    fleet.write_text(text.replace("image =", "# image ="))
    station.app = replace(station.app, fleet=fleet)
    station.start()
    put_in(station)
    page = visit(station)
    station.tell("start")
    until(lambda: station.phase == "over", "the flight is over")
    open_page(page, "Results")
    page.get_by_role("tab", name="Table").click()
    for one in results_of(station):
        if one["kind"] == "measurement":  # sensors err: what it is, only the station knows
            shown = rows_of(page).filter(has_text=f"{one['value']:,.6g} °C")
            expect(shown.first).to_be_visible()
    settled(page)
