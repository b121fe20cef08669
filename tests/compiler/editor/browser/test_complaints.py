"""What users of other graph editors ask for in vain: docs/graph-editor.md names these tests."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.compiler.editor.browser.conftest import Edit, Visit
from tests.compiler.editor.browser.hand import Hand, block, edge, port, statuses
from tests.compiler.editor.browser.texts import text_of, type_below
from tests.kit.station import until

STUCK = """\
pluto 1

app drugs {
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  retry = PriorityManager
  start -> create -> allocate -> launch -> watch
  watch -> retry when FAILED
  watch -> end otherwise
  retry -> allocate when STANDBY
}
"""


def problem(page: Page, words: str) -> None:
    """Open the problems, and press one."""
    page.get_by_role("tab", name=re.compile("^Problems")).first.click()
    page.get_by_role("tabpanel").get_by_role("button", name=re.compile(words)).first.click()


def test_a_problem_leads_to_its_blocks_and_walks_the_way_that_fails(
    edit: Edit, visit: Visit
) -> None:
    page = visit(edit(text=STUCK))
    problem(page, "STANDBY")
    expect(block(page, "watch")).to_have_class(re.compile("chosen"))
    expect(block(page, "watch")).to_have_attribute("data-problem", "error")
    expect(page.locator(".cm-chosen").last).to_contain_text("watch = TripMonitor")
    page.get_by_role("tabpanel").get_by_role("button", name="Walk its path").first.click()
    for name in ("create", "allocate", "launch", "watch"):
        expect(block(page, name)).to_have_class(re.compile("lit"))
    expect(page.locator('.edge.lit[data-edge^="launch>watch"]')).to_have_count(1)


@pytest.mark.long
def test_what_is_greyed_out_says_why(edit: Edit, visit: Visit) -> None:
    page = visit(edit(text=STUCK))
    for name, why in {
        "Compile": "The app has errors: see Problems.",
        "Run": "The app has errors: see Problems.",
        "Undo": "Nothing was changed yet.",
        "Tidy": "No block was moved by hand.",
    }.items():
        button = page.locator(f'[data-command="{name.lower()}"]')
        expect(button).to_have_attribute("aria-disabled", "true")
        expect(button).to_have_attribute("title", re.compile(re.escape(why)))
    page.locator('[data-command="run"]').click(force=True)
    expect(page.get_by_role("status").filter(has_text="The app has errors")).to_have_count(1)


def test_a_wire_that_is_not_legal_says_why(edit: Edit, visit: Visit) -> None:
    page = visit(edit("drugs_distribution"))
    Hand(page).drag(port(page, "watch", "STANDBY"), block(page, "create"))
    expect(page.get_by_role("alert")).to_contain_text("only start leads there")
    page.keyboard.press("Escape")
    assert edge(page, "watch", "create").count() == 0


def test_the_text_leads_and_keeps_its_comments(edit: Edit, visit: Visit) -> None:
    editor = edit("drugs_distribution")
    before = editor.text
    page = visit(editor)
    type_below(page, "watch = TripMonitor", "pause = Clock  # a rest")
    expect(block(page, "pause")).to_be_visible()
    Hand(page).drag(block(page, "pause").locator(".face"), edge(page, "create", "allocate"))
    expect(edge(page, "create", "pause")).to_be_visible()
    assert statuses(page, "pause", "allocate") == ["UNEXECUTED"]
    until(lambda: "pause -> allocate" in editor.text, lambda: editor.text)
    for line in before.split("\n"):
        if "#" in line:
            assert line in editor.text
    order = [editor.text.index(f"{name} = ") for name in ("create", "allocate", "launch", "watch")]
    assert order == sorted(order)


@pytest.mark.long
def test_the_cursor_shows_in_both(edit: Edit, visit: Visit) -> None:
    page = visit(edit("alfalfa"))
    text_of(page).locator(".cm-line", has_text="judge = MissionEvaluator").click()
    expect(block(page, "judge")).to_have_class(re.compile("chosen"))
    text_of(page).locator(".cm-line", has_text="retry -> allocate when STANDBY").click()
    expect(edge(page, "retry", "allocate")).to_have_class(re.compile("chosen"))
    block(page, "launch").locator(".face").click()
    expect(page.locator(".cm-chosen")).to_have_text(re.compile("launch = TripLauncher"))


def test_what_is_not_known_is_not_shown_as_nothing(edit: Edit, visit: Visit) -> None:
    page = visit(edit("alfalfa"))
    type_below(page, "watch = TripMonitor", "more = GateFunel")
    block(page, "more").locator(".face").click()
    expect(page.locator(".passes")).to_have_text(["takesnot known", "givesnot known"])
    type_below(page, "retry -> allocate when STANDBY", "more -> retry")
    unknown = edge(page, "more", "retry")
    expect(unknown).to_have_attribute("title", "more to retry: not known")
    unknown.dispatch_event("pointerdown")
    expect(page.locator(".passes")).to_have_text(["passesnot known"])
    problem(page, "GateFunel")
    page.get_by_role("tabpanel").get_by_role("button", name="P1012").first.click()
    expect(page.get_by_role("dialog")).to_contain_text("P1012")
