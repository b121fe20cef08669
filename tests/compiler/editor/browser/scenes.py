"""The states of the editor, one after the other, that are looked at and read aloud."""

from __future__ import annotations

from collections.abc import Iterator

from playwright.sync_api import Page, expect

from tests.compiler.editor.browser.conftest import Edit, Visit
from tests.compiler.editor.browser.hand import Hand, block, edge, port
from tests.compiler.editor.browser.texts import type_below
from tests.kit.editor import Editor
from tests.kit.station import until
from tests.paths import ROOT

FOLDER = ROOT / "docs" / "graph-editor"
COLOURS = 224
"""Of a picture: it has more colours than the station's pages."""


def scenes(edit: Edit, visit: Visit, size: tuple[int, int]) -> Iterator[tuple[str, Page]]:
    """Bring the editor into each state, and give its name."""
    page = visit(edit(), size=size)
    yield "empty", page
    editor = edit("alfalfa")
    page = visit(editor, size=size)
    yield "graph", page
    yield from _parts(page)
    yield from _dialogs(page)
    yield from _wrong(page, editor)
    yield from _flown(page)


def _parts(page: Page) -> Iterator[tuple[str, Page]]:
    block(page, "judge").locator(".face").click()
    yield "block", page
    edge(page, "first", "judge").click()
    page.get_by_role("radio", name="only when").focus()
    yield "edge", page
    page.keyboard.press("Control+a")
    page.locator(".viewport").focus()
    page.keyboard.press("Control+a")
    yield "many", page
    page.get_by_role("button", name="About TripMonitor").focus()
    page.keyboard.press("Enter")
    yield "documentation", page
    page.keyboard.press("Enter")
    page.get_by_role("tab", name="hooks.py").click()
    page.get_by_role("region", name="What you can use in a hook").get_by_text(
        "trip", exact=True
    ).click()
    yield "hooks", page
    page.get_by_role("tab", name="app.pluto").click()


def _dialogs(page: Page) -> Iterator[tuple[str, Page]]:
    block(page, "watch").locator(".face").click()
    page.keyboard.press("c")
    expect(page.get_by_role("combobox", name="Connect watch to")).to_be_focused()
    yield "connect", page
    page.keyboard.press("Escape")
    page.keyboard.press("a")
    page.keyboard.type("mission")
    yield "quick", page
    page.keyboard.press("Escape")
    page.keyboard.press("?")
    expect(page.get_by_role("dialog", name="Keys and gestures")).to_be_visible()
    yield "help", page
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Compile", exact=True).click()
    expect(page.get_by_role("button", name="Write")).to_be_visible()
    yield "compile", page
    page.keyboard.press("Escape")


def _wrong(page: Page, editor: Editor) -> Iterator[tuple[str, Page]]:
    start = port(page, "watch", "STANDBY")
    box, target = start.bounding_box(), block(page, "create").bounding_box()
    assert box is not None and target is not None
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(target["x"] + 60, target["y"] + 20, steps=6)
    expect(page.locator(".why-not")).to_be_visible()
    yield "wiring", page
    page.keyboard.press("Escape")
    page.mouse.up()
    before = editor.text
    type_below(page, "watch = TripMonitor", "stop = GateFunel")
    page.get_by_role("tab", name="Problems").click()
    expect(page.locator(".problem-title").first).to_be_visible()
    yield "problems", page
    page.locator(".problem-tools .link").first.click()
    expect(page.get_by_role("dialog")).to_be_visible()
    yield "explained", page
    page.keyboard.press("Escape")
    until(lambda: "GateFunel" in editor.text, "it is on the disk")
    editor.file.write_text(before)
    expect(page.get_by_text("Sound", exact=True)).to_be_visible()
    page.get_by_role("button", name="Close this notice").click()


def _flown(page: Page) -> Iterator[tuple[str, Page]]:
    page.get_by_role("button", name="Run", exact=True).click()
    expect(page.locator(".run-result")).to_contain_text("completed")
    play = page.get_by_role("button", name="Pause")
    if play.count():
        play.click()
    slider = page.get_by_role("slider", name="Time of the run")
    box = slider.bounding_box()
    assert box is not None
    Hand(page).click((box["x"] + box["width"] * 0.42, box["y"] + box["height"] / 2))
    yield "run", page
