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


def test_fields_of_missions_and_trips(edit: Edit, visit: Visit) -> None:
    """One types the name over the one that it came with, and then its type; it is taken out again."""
    editor = edit("drugs_distribution")
    before = editor.text
    page = visit(editor)
    declare(page, "field of missions")
    expect(line_of(page, "mission.note")).to_be_focused()
    page.keyboard.type("patient")
    page.keyboard.press("Enter")
    line = line_of(page, "mission.patient")
    expect(line).to_have_value('patient: text = ""')
    until(lambda: 'mission has patient: text = ""' in editor.text, lambda: editor.text)
    line.fill("status: time")
    line.press("Enter")
    expect(page.get_by_role("alert")).to_contain_text("every mission of this app has a `status`")
    line.press("Escape")
    page.get_by_role("button", name="Remove mission.patient", exact=True).click()
    until(lambda: editor.text.split() == before.split(), lambda: editor.text)
