"""What an app declares, without a line of text: fields of its own, evaluators and actions with their types."""

from __future__ import annotations

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.compiler.editor.browser.conftest import Edit, Visit
from tests.kit.station import until

pytestmark = pytest.mark.long


def declare(page: Page, what: str) -> None:
    """Choose what to declare; its name is selected then."""
    page.get_by_role("button", name="Declare").click()
    page.keyboard.type(what)
    page.keyboard.press("Enter")


def line_of(page: Page, name: str) -> Locator:
    """Return the line in which something is declared."""
    return page.get_by_role("textbox", name=f"The declaration of {name}", exact=True)


def write(line: Locator, text: str) -> None:
    line.fill(text)
    line.press("Enter")


def test_fields_of_missions_and_trips(edit: Edit, visit: Visit) -> None:
    """One types the name over the one that it came with, and then its type; each is taken out again."""
    editor = edit("drugs_distribution")
    before = editor.text
    page = visit(editor)
    declare(page, "field of missions")
    expect(line_of(page, "mission.note")).to_be_focused()
    page.keyboard.type("patient")
    page.keyboard.press("Enter")
    expect(line_of(page, "mission.patient")).to_have_value('patient: text = ""')
    expect(line_of(page, "mission.patient")).to_be_focused()
    declare(page, "field of trips")
    expect(line_of(page, "trip.note")).to_be_focused()
    write(line_of(page, "trip.note"), "depth: length = 30 cm")
    expect(line_of(page, "trip.depth")).to_be_visible()
    declare(page, "field of missions")
    write(line_of(page, "mission.note"), "margin: time")
    text = 'mission has patient: text = ""\n  trip has depth: length = 30 cm\n  mission has margin: time\n'
    until(lambda: text in editor.text, lambda: editor.text)
    write(line_of(page, "mission.margin"), "status: time")
    expect(page.get_by_role("alert")).to_contain_text("every mission of this app has a `status`")
    line_of(page, "mission.margin").press("Escape")
    expect(page.get_by_text("Missions files are not changed")).to_have_count(
        0
    )  # none can have them
    for name in ("mission.patient", "trip.depth", "mission.margin"):
        page.get_by_role("button", name=f"Remove {name}", exact=True).click()
        expect(line_of(page, name)).to_have_count(0)
    until(lambda: editor.text.split() == before.split(), lambda: editor.text)
