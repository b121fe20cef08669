"""Two editors of one file, a file that is changed elsewhere, a server that dies; and back to the first byte."""

from __future__ import annotations

from pathlib import Path
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Page, expect

from tests.compiler.editor.browser.conftest import Edit, Visit
from tests.compiler.editor.browser.hand import Hand, block, edge, port
from tests.compiler.editor.browser.texts import shown, text_of, type_below
from tests.kit.browser import Watch
from tests.kit.editor import Edited, EditorProcess, fresh
from tests.kit.station import until

SOURCE = """\
pluto 1

# Kept: blank  spaces, and all.
app drugs "Drugs" {
  create = MissionCreator
  allocate = DroneAllocator(policy:   least_used)

  launch = TripLauncher   # flies
  watch = TripMonitor
  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY


  watch -> end otherwise
}
"""


def same_everywhere(editor: Edited, *pages: Page) -> None:
    """See that all pages and the disk have the same text."""
    until(
        lambda: all(shown(page).strip() == editor.text.strip() for page in pages),
        lambda: f"all have the same text: {[editor.text, *map(shown, pages)]}",
    )


def test_two_editors_see_each_other_at_once(edit: Edit, visit: Visit) -> None:
    editor = edit(text=SOURCE)
    one, other = visit(editor), visit(editor)
    type_below(one, "watch = TripMonitor", "retry = PriorityManager")
    expect(block(other, "retry")).to_be_visible()
    Hand(other).drag(port(other, "watch", "FAILED"), block(other, "retry"))
    expect(edge(one, "watch", "retry")).to_be_visible()
    type_below(one, "# Kept: blank", "# from the one")
    type_below(other, "launch = TripLauncher", "# from the other")
    same_everywhere(editor, one, other)
    assert "# from the one" in editor.text and "# from the other" in editor.text
    one.keyboard.press("Control+z")
    one.keyboard.press("Control+z")
    until(lambda: "# from the" not in editor.text, lambda: f"both are undone: {editor.text}")
    same_everywhere(editor, one, other)


@pytest.mark.long
def test_typing_at_one_place_by_two_ends_in_one_text(edit: Edit, visit: Visit) -> None:
    editor = edit(text=SOURCE)
    one, other = visit(editor), visit(editor)
    for page in (one, other):
        text_of(page).locator(".cm-line", has_text="# Kept: blank").click()
        page.keyboard.press("End")
    for letter in "abcdefgh":
        one.keyboard.insert_text(letter)
        other.keyboard.insert_text(letter.upper())
    same_everywhere(editor, one, other)
    line = next(line for line in editor.text.split("\n") if line.startswith("# Kept"))
    typed = line.removeprefix("# Kept: blank  spaces, and all.")
    assert [letter for letter in typed if letter.islower()] == list("abcdefgh")
    assert [letter for letter in typed if letter.isupper()] == list("ABCDEFGH")


def test_where_it_contradicts_one_is_asked(edit: Edit, visit: Visit) -> None:
    editor = edit(text=SOURCE)
    page = visit(editor)
    text_of(page).locator(".cm-line", has_text="launch = TripLauncher").click()
    page.keyboard.press("End")
    page.keyboard.insert_text(" fast")
    theirs = SOURCE.replace("# flies", "# flies and flies")
    editor.file.write_text(theirs)
    bar = page.get_by_role("alert").filter(has_text="changed elsewhere, in the same place")
    expect(bar).to_be_visible()
    bar.get_by_role("button", name="Show both").click()
    both = page.get_by_role("dialog", name="Both texts")
    expect(both.locator("pre").first).to_contain_text("# flies fast")
    expect(both.locator("pre").last).to_contain_text("# flies and flies")
    page.keyboard.press("Escape")
    bar.get_by_role("button", name="Take theirs").click()
    expect(bar).to_be_hidden()
    same_everywhere(editor, page)
    assert editor.text == theirs


@pytest.mark.long  # real processes
def test_a_killed_server_loses_nothing_that_was_saved_and_its_pages_say_what_to_do(
    tmp_path: Path, visit: Visit, watch: Watch
) -> None:
    watch.expected.append("net::ERR_CONNECTION_REFUSED")
    file = fresh("", tmp_path / "app")
    file.write_text(SOURCE)
    editor = EditorProcess(file=file)
    editor.start()
    try:
        page = visit(editor)
        type_below(page, "watch = TripMonitor", "retry = PriorityManager")
        until(lambda: "retry = PriorityManager" in editor.text, "it is on the disk")
        editor.kill()
        expect(page.get_by_role("alert").filter(has_text="does not answer")).to_be_visible()
        assert "retry = PriorityManager" in editor.text
        editor.start(urlsplit(page.url).port or 0)
        said = "The editor was started again: open the address that it printed."
        again = page.get_by_role("alert").filter(has_text=said)
        expect(again).to_be_visible()
        expect(page.get_by_text("No server", exact=True)).to_be_visible()
        other = page.context.new_page()
        other.goto(editor.url)  # which has the token from now on
        expect(again).to_be_hidden()
        type_below(page, "watch = TripMonitor", "more = PriorityManager")
        same_everywhere(editor, page, other)
        page.context.clear_cookies()
        page.reload()
        expect(page.get_by_text("open the address that the editor printed")).to_be_visible()
    finally:
        editor.end()


def test_undo_ends_at_the_first_byte_and_redo_leads_on_from_there(edit: Edit, visit: Visit) -> None:
    first = SOURCE.replace("\n", "\r\n", 5).encode()
    editor = edit(text=first)
    page = visit(editor)
    hand = Hand(page)
    hand.add("Clock")
    type_below(page, "# Kept: blank", "# typed")
    hand.drag(block(page, "create").locator(".face"), (420, 300))
    block(page, "watch").locator(".face").click()
    page.keyboard.press("Control+d")
    expect(block(page, "watch_2")).to_be_visible()
    page.keyboard.press("Control+c")
    page.keyboard.press("Control+v")
    expect(block(page, "watch_3")).to_be_visible()
    page.keyboard.press("Delete")
    expect(block(page, "watch_3")).to_be_hidden()
    layout = editor.file.with_name("drugs.pluto.layout")
    until(lambda: layout.exists() and "watch_2" in editor.text, "it is all on the disk")
    undo = page.locator('[data-command="undo"]')
    for _ in range(30):
        if undo.get_attribute("aria-disabled"):
            break
        undo.click(force=True)  # it may have come to its end just now
        expect(page.get_by_text("Saving …", exact=True)).to_be_hidden()
    expect(undo).to_have_attribute("aria-disabled", "true")
    until(lambda: editor.file.read_bytes() == first, lambda: repr(editor.file.read_bytes()))
    until(lambda: not layout.exists() or not layout.read_text(), "no block is moved")
    for _ in range(2):
        page.keyboard.press("Control+Shift+z")
    until(lambda: "# typed" in editor.text, lambda: f"two are done again: {editor.text}")
    assert "clock = Clock" in editor.text
    assert "watch_2" not in editor.text
