"""A plan leaves the page as a missions file, and comes back as one."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import FileChooser, Page, expect

from tests.kit.browser import Watch
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import PLAN, put_in
from tests.library.station.browser.steps import missions_listed, open_page
from tests.release.environments import succeed

pytestmark = pytest.mark.long


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
