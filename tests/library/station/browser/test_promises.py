"""When a mission begins, and when it is due: drawn on the page Missions, seen on the Monitor."""

from __future__ import annotations

import tomllib

import pytest
from playwright.sync_api import Page, expect

from tests.kit.station import until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import PLAN, put_in
from tests.library.station.browser.steps import (
    A_FLIGHT,
    open_page,
    row_of,
    sees_all,
    select_mission,
    start,
)

pytestmark = pytest.mark.long

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
