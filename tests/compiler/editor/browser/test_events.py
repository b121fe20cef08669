"""Events in the picture: sources that are declared, dragged and led to what makes missions of them."""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from tests.compiler.editor.browser.conftest import Edit, Visit
from tests.kit.station import until
from tests.paths import CASES

pytestmark = pytest.mark.long

PURSUE = (CASES / "pursue" / "app.pluto").read_text(encoding="utf-8")


def test_an_event_is_drawn_as_a_source_and_added_from_the_palette(edit: Edit, visit: Visit) -> None:
    """Its declaration is a line among the properties of the app, which takes it out again, too."""
    editor = edit(text=PURSUE, file=None)
    page = visit(editor)
    drawn = page.locator('[data-block="intruder"]')
    expect(drawn).to_have_attribute("aria-roledescription", "event")
    page.get_by_role("button", name="Add event: ").click()
    until(lambda: "event my_event" in editor.text, lambda: editor.text)
    expect(page.locator('[data-block="my_event"]')).to_have_attribute("aria-pressed", "true")
    page.keyboard.press("Escape")
    page.get_by_role("application", name="Graph").click(position={"x": 5, "y": 5})
    line = page.get_by_role("textbox", name="The declaration of my_event", exact=True)
    line.fill("event smoke(density: percent)")
    line.press("Enter")
    until(lambda: "event smoke(density: percent)" in editor.text, lambda: editor.text)
    page.get_by_role("button", name="Remove smoke", exact=True).click()
    until(lambda: "smoke" not in editor.text, lambda: editor.text)
