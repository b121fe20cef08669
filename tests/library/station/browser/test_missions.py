"""The page Missions: what an app wants to know of each, promises, fields of its own, and files."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.kit.station import until
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


def fields(page: Page, action: str = "measure") -> tuple[set[str], set[str]]:
    """Draw a mission with one trip; return what can be filled in of both."""
    add_mission(page, "Look")
    drag(page, action, (3.0, 5.0))
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
    mission, trip = fields(visit(serve("night_round")), "listen")
    assert mission >= {"Name", "Safe time", "Patient", "Most"}
    assert "Priority" in trip


FIRST, SECOND, *_ = PLAN


def promise(page: Page, mission: str) -> None:
    """Select a mission, and open what may be promised of it."""
    open_page(page, "Missions")
    select_mission(page, mission)
    if page.locator("details.promises").get_attribute("open") is None:
        page.get_by_text("When it begins, and when it is due").click()


def test_promises_are_drawn_kept_exported_and_seen(serve: Serve, visit: Visit) -> None:
    station = put_in(serve("drugs_distribution"))
    page = visit(station)
    promise(page, FIRST)
    page.get_by_label("Due").fill("5 s")
    promise(page, SECOND)
    group = page.get_by_role("group", name="Begins after")
    group.get_by_role("checkbox", name=FIRST).check()
    until(lambda: [one.get("after") for one in station.missions][1] == [FIRST], "the order is kept")
    expect(page.get_by_role("option").nth(0)).to_contain_text("due 5 s")
    expect(page.get_by_role("option").nth(1)).to_contain_text(f"after {FIRST}")
    page.reload()
    promise(page, FIRST)
    expect(page.get_by_label("Due")).to_have_value("5 s")
    promise(page, SECOND)
    expect(group.get_by_role("checkbox", name=FIRST)).to_be_checked()
    with page.expect_download() as asked:
        page.get_by_role("button", name="Export file").click()
    written = tomllib.loads(asked.value.path().read_text(encoding="utf-8"))["mission"]
    assert (written[0]["deadline"], written[1]["after"]) == ("5 s", [FIRST])
    start(page)
    expect(row_of(page, SECOND)).to_contain_text(f"comes after {FIRST}")
    expect(row_of(page, FIRST).locator(".chip.bad")).to_have_text("Late", timeout=A_FLIGHT)
    sees_all(page, "Completed")


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
    with second.expect_file_chooser() as chooser:
        second.get_by_role("button", name="Import file").click()
    chooser.value.set_files(file)
    expect(missions_listed(second)).to_have_text(list(PLAN))
    drawn, read = (one.get("/api/plan")["missions"] for one in (station, other))
    for before, after in zip(drawn, read, strict=True):
        assert [trip["target"] for trip in before["trips"]] == [
            trip["target"] for trip in after["trips"]
        ]
