"""What was drawn on a page is undone and done again there; what others draw is seen, and nothing of it lost."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from tests.kit.browser import Watch
from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import names
from tests.library.station.browser.steps import (
    ANOTHER_WAS_QUICKER,
    add_mission,
    drag,
    missions_listed,
    open_page,
    select_mission,
)


def rename(page: Page, mission: str, name: str) -> None:
    """Type another name, letter by letter, and leave the field."""
    select_mission(page, mission)
    field = page.get_by_role("textbox", name="Name")
    field.press("Control+a")
    field.press_sequentially(name)
    field.press("Tab")


def test_all_is_undone_and_done_again_step_by_step_over_a_reload(
    planned: Station, visit: Visit
) -> None:
    """A word that was typed is one step; deleting several missions is one, too."""
    page = visit(planned)
    rename(page, "Mission 1", "Beds")
    select_mission(page, "Mission 3")
    page.keyboard.press("Shift+ArrowUp")
    page.get_by_role("region", name="Selected missions").get_by_role(
        "button", name="Delete"
    ).click()
    until(lambda: names(planned) == ["Beds"], "they are gone")
    page.reload()
    expect(missions_listed(page)).to_have_text(["Beds"])
    page.keyboard.press("Control+z")
    expect(missions_listed(page)).to_have_text(["Beds", "Mission 2", "Mission 3"])
    page.keyboard.press("Control+z")
    expect(missions_listed(page)).to_have_text(["Mission 1", "Mission 2", "Mission 3"])
    expect(page.get_by_role("button", name="Undo (Ctrl+Z)")).to_be_disabled()
    page.keyboard.press("Control+Shift+z")
    page.keyboard.press("Control+y")
    until(lambda: names(planned) == ["Beds"], "both are done again")


def test_what_one_draws_the_other_sees(serve: Serve, visit: Visit, watch: Watch) -> None:
    watch.expected.append(ANOTHER_WAS_QUICKER)  # the trip may still be on its way to the other
    station = serve()
    one, other = visit(station), visit(station)
    add_mission(one, "From here")
    drag(one, "measure", (3.0, 5.0))
    expect(missions_listed(other)).to_have_text(["From here"])
    add_mission(other, "From there")
    open_page(one, "Missions")
    expect(missions_listed(one)).to_have_text(["From here", "From there"])
    until(lambda: len(station.missions) == 2, "both are kept")
