"""The text pane, as a person reads it and types in it."""

from __future__ import annotations

from playwright.sync_api import Locator, Page, expect


def text_of(page: Page) -> Locator:
    """Return the text pane of the app."""
    return page.get_by_role("textbox", name="The app as Pluto text")


def shown(page: Page) -> str:
    """Return the text as the pane has it, line by line."""
    return "\n".join(text_of(page).locator(".cm-line").all_text_contents()).replace("\u200b", "")


def type_below(page: Page, line: str, text: str) -> None:
    """Type behind a line of the text."""
    page.mouse.move(0, 0)  # an explanation of what the mouse was over goes
    expect(page.locator(".cm-tooltip-hover")).to_have_count(0)
    text_of(page).locator(".cm-line", has_text=line).first.click()
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    page.keyboard.insert_text(text)
