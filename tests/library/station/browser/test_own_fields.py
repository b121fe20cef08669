"""Fields of an app's own: asked for, judged beside where they are typed, kept, handed out and flown with."""

from __future__ import annotations

import tomllib
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.steps import (
    A_FLIGHT,
    card_of,
    open_page,
    row_of,
    select_mission,
    start,
)

pytestmark = pytest.mark.long

BED, OTHER = "Bed 1", "Bed 2"
BEDS = {BED: (5.5, 8.5), OTHER: (9.5, 8.5)}


def beds(**given: object) -> list[dict[str, Any]]:
    """Return two missions, of one trip each, that lack what must be filled in."""
    return [
        {
            "key": f"mission-{n}",
            "name": name,
            "trips": [
                {
                    "key": f"trip-{n}-1",
                    "action": "listen",
                    "target": list(at),
                    "parameters": {},
                    "item": None,
                    **given,
                }
            ],
        }
        for n, (name, at) in enumerate(BEDS.items(), 1)
    ]


def ward(serve: Serve, missions: list[dict[str, Any]]) -> Station:
    station = serve("night_ward")
    station.plan(missions)
    return station


def field(page: Page, name: str) -> Locator:
    """Return a field of the selected mission, with its label and what is said of it."""
    return page.locator(f'.mission-panel .field[data-field="{name}"]')


def listed(page: Page, mission: str) -> Locator:
    """Return a mission's place in the list."""
    return page.get_by_role("option").filter(has=page.get_by_text(mission, exact=True))


def test_what_is_not_filled_in_is_said_before_start(serve: Serve, visit: Visit) -> None:
    """At the field, in the list, and beside Start, from where a press leads to the field."""
    page = visit(ward(serve, beds()))
    expect(page.get_by_role("button", name="Start 2 missions")).to_be_disabled()
    expect(listed(page, BED)).to_contain_text("To mend")  # of its trip
    page.get_by_text("Bed 1: Patient is not filled in yet").click()
    patient = page.get_by_label("Patient")
    expect(patient).to_be_focused()
    expect(patient).to_have_attribute("aria-required", "true")
    expect(patient).to_have_attribute("placeholder", "to be filled in")
    expect(field(page, "patient").locator(".problem")).to_have_text("Patient is not filled in yet")
    patient.fill("Amato")
    expect(field(page, "patient").locator(".problem")).to_be_hidden()
    expect(listed(page, BED)).to_contain_text("1 trip · Amato")
    page.get_by_text("Bed 1, trip 1: Softly is not filled in yet").click()
    softly = card_of(page, 1).get_by_label("Softly")
    expect(softly).to_be_focused()
    softly.select_option("yes")
    expect(card_of(page, 1).locator(".problem:visible")).to_have_count(0)
    open_page(page, "Missions")
    expect(listed(page, BED).locator(".chip")).to_be_hidden()
    select_mission(page, OTHER)
    expect(page.get_by_text("Bed 2: Patient is not filled in yet")).to_be_visible()


def test_what_was_filled_in_is_kept_handed_out_and_flown_with(serve: Serve, visit: Visit) -> None:
    station = ward(serve, beds(softly=False))
    page = visit(station)
    for bed, patient in ((BED, "Amato"), (OTHER, "Bianchi")):
        select_mission(page, bed)
        page.get_by_label("Patient").fill(patient)
    page.get_by_label("Most").fill("12,5")
    page.get_by_label("Margin").fill("3 min")
    until(lambda: station.missions[1].get("margin") == "3 min", "what was typed last is kept")
    page.reload()
    select_mission(page, OTHER)
    expect(page.get_by_label("Patient")).to_have_value("Bianchi")
    with page.expect_download() as asked:
        page.get_by_role("button", name="Export file").click()
    one, two = tomllib.loads(asked.value.path().read_text(encoding="utf-8"))["mission"]
    assert (one["patient"], two["patient"], two["most"]) == ("Amato", "Bianchi", 12.5)
    assert two["margin"] == "3 min" and "margin" not in one
    assert [trip["softly"] for trip in one["trip"]] == [False]
    start(page)
    expect(row_of(page, BED)).to_contain_text("Amato")
    expect(page.get_by_text("Patient: Bianchi · Most: 12.5 · Margin: 3 min")).to_be_visible()
    for bed in BEDS:
        expect(row_of(page, bed)).to_contain_text("Completed", timeout=A_FLIGHT)
    page.get_by_role("tab", name="Console").click()
    console = page.get_by_role("log")
    expect(console).to_contain_text("Amato sleeps: 14 breaths a minute")
    expect(console).to_contain_text("LOOK IN: Bianchi breathes 14 times a minute")
