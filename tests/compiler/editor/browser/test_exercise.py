"""The thesis's first exercise, from an empty canvas to a flown simulation: by mouse, and by keyboard."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from plutoc.compile import analyse
from plutoc.diagnostic import Rejected
from plutoc.source import Source
from tests.compiler.editor.browser.conftest import Edit, Visit
from tests.compiler.editor.browser.hand import Hand, block, port, statuses
from tests.kit.command import plutoc
from tests.kit.editor import Editor
from tests.kit.station import until

FEW = 25
"""Gestures."""

KINDS = ["MissionCreator", "DroneAllocator", "TripLauncher", "TripMonitor"]


def is_drawn(editor: Editor) -> bool:
    """Return whether the app on the disk is the basic drugs distribution."""
    if "monitor -> end" not in editor.text:
        return False
    try:
        checked, _ = analyse(Source(editor.file.name, editor.text))
    except Rejected:  # not all is saved yet
        return False
    kinds = {node.name: node.block.name for node in checked.graph.nodes}
    named = {"start": "start", "end": "end"} | kinds
    found = {
        (named[one.source], named[one.target], tuple(sorted(s.value for s in statuses)))
        for one, statuses in checked.carries.items()
    }
    create, allocate, launch, watch = KINDS
    return sorted(kinds.values()) == sorted(KINDS) and found == {
        ("start", create, ("UNEXECUTED",)),
        (create, allocate, ("UNEXECUTED",)),
        (allocate, launch, ("STANDBY", "UNEXECUTED")),
        (launch, watch, ("RUNNING",)),
        (watch, allocate, ("STANDBY",)),
        (watch, "end", ("COMPLETED", "FAILED")),
    }


def sees_the_flight(page: Page) -> None:
    """See that all missions completed, and that the scrubber leads back to before they began."""
    result = page.locator(".run-result")
    expect(result).to_contain_text("completed")
    found = re.match(r"(\d+) of (\d+) missions completed", result.inner_text())
    assert found is not None and found[1] == found[2] != "0", result.inner_text()


def test_by_mouse_in_few_gestures_drawn_flown_and_compiled(edit: Edit, visit: Visit) -> None:
    editor = edit()
    page = visit(editor)
    hand = Hand(page)
    for kind in KINDS:
        hand.add(kind)
    hand.drag(port(page, "monitor", "STANDBY"), block(page, "allocator"))
    expect(page.locator('.chip[data-edge="monitor>allocator?STANDBY"]')).to_be_visible()
    hand.drag(port(page, "monitor"), block(page, "end"))
    expect(page.locator('.chip[data-edge="monitor>end?"]')).to_be_visible()
    assert statuses(page, "monitor", "end") == ["COMPLETED", "FAILED"]
    until(lambda: is_drawn(editor), lambda: f"the graph is drawn: {editor.text}")
    hand.click(page.get_by_role("button", name="Run", exact=True))
    sees_the_flight(page)
    slider = page.get_by_role("slider", name="Time of the run")
    box = slider.bounding_box()
    assert box is not None
    hand.click((box["x"] + box["width"] / 2, box["y"] + box["height"] / 2))
    expect(page.locator(".block .token").first).to_be_visible()
    assert hand.gestures <= FEW, hand.gestures
    page.get_by_role("button", name="Compile", exact=True).click()
    page.get_by_role("button", name=re.compile("^Write ")).click()
    expect(page.get_by_text("The package is written to drugs.")).to_be_visible()
    assert plutoc("compile", editor.file, "--check").code == 0


@pytest.mark.long
def test_by_keyboard_alone(edit: Edit, visit: Visit) -> None:
    editor = edit()
    page = visit(editor)
    keys = page.keyboard
    keys.press("F6")
    expect(block(page, "start")).to_be_focused()
    for number, kind in enumerate(KINDS, start=1):
        keys.press("a")
        keys.type(kind)
        keys.press("Enter")
        expect(page.locator(".block")).to_have_count(number + 2)
    expect(block(page, "monitor")).to_be_focused()
    keys.press("c")
    expect(page.get_by_role("combobox", name="Connect monitor to")).to_be_focused()
    keys.press("Shift+Tab")  # the statuses stand above the list
    keys.press("Shift+Tab")
    keys.press("Shift+Tab")
    expect(page.get_by_role("checkbox", name="STANDBY")).to_be_focused()
    keys.press("Space")
    for _ in range(3):
        keys.press("Tab")
    keys.type("alloc")
    keys.press("Enter")
    expect(page.locator('.chip[data-edge="monitor>allocator?STANDBY"]')).to_be_visible()
    expect(block(page, "monitor")).to_be_focused()
    keys.press("c")
    keys.type("end")
    keys.press("Enter")
    expect(page.locator('.chip[data-edge="monitor>end?"]')).to_be_visible()
    until(lambda: is_drawn(editor), lambda: f"the graph is drawn: {editor.text}")
    keys.press("Control+Enter")
    sees_the_flight(page)
    expect(page.get_by_role("button", name=re.compile("Play|Pause"))).to_be_focused()
    keys.press("Shift+Tab")
    expect(page.get_by_role("button", name="Back to the start")).to_be_focused()
    keys.press("Enter")
    expect(page.locator(".run-missions .where").first).to_have_text("not begun")


@pytest.mark.long
def test_what_is_typed_ahead_counts(edit: Edit, visit: Visit) -> None:
    editor = edit("drugs_distribution")
    page = visit(editor)
    keys = page.keyboard
    keys.press("F6")
    keys.press("ArrowDown")
    expect(block(page, "create")).to_be_focused()
    keys.press("e")
    keys.press("Delete")
    expect(page.locator('.chip[data-edge="create>allocate?"]')).to_have_count(0)
    block(page, "create").focus()
    with editor.answering_late():
        keys.press("c")
        keys.type("alloc")
        keys.press("Enter")
    expect(page.locator('.chip[data-edge="create>allocate?"]')).to_be_visible()
    expect(page.get_by_role("combobox", name="Connect create to")).to_be_hidden()
