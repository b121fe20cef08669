"""The page Missions: what an app wants to know of each, promises, fields of its own, and files."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import FileChooser, Locator, Page, expect

from tests.kit.browser import Watch
from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import PLAN, put_in
from tests.library.station.browser.steps import (
    A_FLIGHT,
    add_mission,
    card_of,
    drag,
    labels,
    missions_listed,
    open_page,
    row_of,
    sees_all,
    select_mission,
    start,
)
from tests.release.environments import succeed

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


FIRST, SECOND, *_ = PLAN


def promise(page: Page, mission: str) -> None:
    """Select a mission, and open what may be promised of it."""
    open_page(page, "Missions")
    select_mission(page, mission)
    if page.locator("details.promises").get_attribute("open") is None:
        page.get_by_text("When it begins, and when it is due").click()


def tick(page: Page, mission: str) -> None:
    """Let the selected mission begin after this one."""
    page.get_by_role("group", name="Begins after").get_by_role("checkbox", name=mission).check()


def test_promises_are_drawn_kept_exported_and_seen(serve: Serve, visit: Visit) -> None:
    station = put_in(serve("drugs_distribution"))
    page = visit(station)
    promise(page, FIRST)
    page.get_by_label("Due").fill("5 s")
    promise(page, SECOND)
    tick(page, FIRST)
    until(lambda: [one.get("after") for one in station.missions][1] == [FIRST], "the order is kept")
    expect(page.get_by_role("option").nth(0)).to_contain_text("due 5 s")
    expect(page.get_by_role("option").nth(1)).to_contain_text(f"after {FIRST}")
    page.reload()
    promise(page, FIRST)
    expect(page.get_by_label("Due")).to_have_value("5 s")
    promise(page, SECOND)
    group = page.get_by_role("group", name="Begins after")
    expect(group.get_by_role("checkbox", name=FIRST)).to_be_checked()
    with page.expect_download() as asked:
        page.get_by_role("button", name="Export file").click()
    written = tomllib.loads(asked.value.path().read_text(encoding="utf-8"))["mission"]
    assert (written[0]["deadline"], written[1]["after"]) == ("5 s", [FIRST])
    start(page)
    expect(row_of(page, SECOND)).to_contain_text(f"comes after {FIRST}")
    expect(row_of(page, FIRST).locator(".chip.bad")).to_have_text("Late", timeout=A_FLIGHT)
    sees_all(page, "Completed")


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


def choose(page: Page, button: str, file: Path) -> None:
    """Press a button that asks for a file, and choose this one."""
    with page.expect_file_chooser() as asked:
        page.get_by_role("button", name=button).click()
    chooser: FileChooser = asked.value
    chooser.set_files(file)


def test_what_is_exported_can_be_checked_by_the_app_and_imported_elsewhere(
    serve: Serve, visit: Visit, tmp_path: Path
) -> None:
    station, other = serve(), serve(own=True)
    put_in(station)
    page = visit(station)
    with page.expect_download() as asked:
        page.get_by_role("button", name="Export file").click()
    file = tmp_path / asked.value.suggested_filename
    asked.value.save_as(file)
    assert file.suffix == ".toml"
    succeed(station.app.program, "check", file, "--fleet", station.app.fleet)

    second = visit(other)
    choose(second, "Import a missions file", file)
    expect(missions_listed(second)).to_have_text(list(PLAN))
    drawn, read = (one.get("/api/plan")["missions"] for one in (station, other))
    for before, after in zip(drawn, read, strict=True):
        assert [trip["target"] for trip in before["trips"]] == [
            trip["target"] for trip in after["trips"]
        ]


def test_a_file_that_is_no_plan_is_refused_with_its_lines_and_nothing_changes(
    serve: Serve, visit: Visit, watch: Watch, tmp_path: Path
) -> None:
    watch.expected += ["400"]
    station = put_in(serve("drugs_distribution"))
    before = station.get("/api/plan")
    page = visit(station)
    wrong = tmp_path / "wrong.toml"
    wrong.write_text('[[mission]]\nname = "A"\nspeed = 3\n')
    choose(page, "Import file", wrong)
    expect(page.get_by_role("alert").filter(has_text="speed")).to_contain_text("wrong.toml:3: ")
    open_page(page, "Missions")
    expect(missions_listed(page)).to_have_text(list(PLAN))
    assert station.get("/api/plan") == before
