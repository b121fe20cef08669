"""The thesis's second and third exercise, drawn upon the first: retry and delay; a timer of one's own."""

from __future__ import annotations

import re

from playwright.sync_api import Page, expect

from plutoc.compile import analyse
from plutoc.diagnostic import Rejected
from plutoc.source import Source
from tests.compiler.editor.browser.conftest import Edit, Visit
from tests.compiler.editor.browser.drawing import add_from_port, complete, lead, put_between, rename
from tests.compiler.editor.browser.hand import Hand, block, edge, port
from tests.compiler.editor.browser.texts import text_of
from tests.kit.editor import Editor
from tests.kit.station import until

Way = tuple[str, str, str]

FIRST = """\
pluto 1

# The basic graph of nearly every app.
app drugs "Drugs distribution" {
  create = MissionCreator
  allocate = DroneAllocator(policy: least_used)  # wears the drones evenly
  launch = TripLauncher
  watch = TripMonitor

  start -> create -> allocate -> launch -> watch
  # STANDBY: there is more to do.
  watch -> allocate when STANDBY
  watch -> end otherwise
}
"""


def ways(editor: Editor) -> set[Way]:
    """Return the edges of the app on the disk, each with the statuses that pass; none if it has errors."""
    try:
        checked, _ = analyse(Source(editor.file.name, editor.text))
    except Rejected:  # not all is saved yet
        return set()
    return {
        (one.source, one.target, " ".join(sorted(status.value for status in statuses)))
        for one, statuses in checked.carries.items()
    }


def with_retry_and_delay(page: Page) -> None:
    """Draw the second exercise upon the first."""
    put_between(page, "Clock", "create", "allocate")
    rename(page, "clock", "wait")
    lead(page, "watch", "allocate", "target", "wait")
    add_from_port(page, "watch", "FAILED", "PriorityManager", "manager")
    rename(page, "manager", "retry")
    hand = Hand(page)
    hand.drag(port(page, "retry", "STANDBY"), block(page, "allocate"))
    expect(edge(page, "retry", "allocate")).to_be_visible()
    hand.drag(port(page, "retry", "FAILED"), block(page, "end"))
    expect(edge(page, "retry", "end")).to_be_visible()


SECOND = {
    ("start", "create", "UNEXECUTED"),
    ("create", "wait", "UNEXECUTED"),
    ("wait", "allocate", "STANDBY UNEXECUTED"),
    ("allocate", "launch", "STANDBY UNEXECUTED"),
    ("launch", "watch", "RUNNING"),
    ("watch", "wait", "STANDBY"),
    ("watch", "retry", "FAILED"),
    ("watch", "end", "COMPLETED"),
    ("retry", "allocate", "STANDBY"),
    ("retry", "end", "FAILED"),
}


def test_retry_and_delay(edit: Edit, visit: Visit) -> None:
    editor = edit(text=FIRST)
    page = visit(editor)
    with_retry_and_delay(page)
    until(lambda: ways(editor) == SECOND, lambda: editor.text)
    for comment in re.findall(r"#.*", FIRST):
        assert comment in editor.text


def test_a_timer_of_ones_own(edit: Edit, visit: Visit) -> None:
    editor = edit(text=FIRST)
    page = visit(editor)
    with_retry_and_delay(page)
    # a gate behind the monitor, a modifier beside it
    put_between(page, "GateFIFO", "watch", "wait")
    rename(page, "fifo", "first")
    lead(page, "watch", "retry", "source", "first")
    lead(page, "watch", "end", "source", "first")
    edge(page, "watch", "first").click()
    page.get_by_role("radio", name="all that fits").check()
    add_from_port(page, "launch", "RUNNING", "MissionModifier", "mission_modifier")
    rename(page, "mission_modifier", "limit")
    Hand(page).drag(port(page, "limit"), block(page, "first"))
    expect(edge(page, "limit", "first")).to_be_visible()
    # its hook: what it takes and gives
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    declaration = page.locator(".declarations input.mono").last
    declaration.fill("modifier limit_trip(limit: time = 3 min) emits STANDBY, COMPLETED, FAILED")
    declaration.press("Enter")
    block(page, "limit").locator(".face").click()
    value = page.locator('.field[data-field="limit"] input')
    value.fill("2 metres")
    expect(page.locator('.field[data-field="limit"] .field-problem')).to_contain_text(
        "“metres” is no unit of a time"
    )
    value.fill("2 min")
    value.press("Enter")
    third = (SECOND - {way for way in SECOND if way[0] == "watch"}) | {
        ("launch", "limit", "RUNNING"),
        ("limit", "first", "COMPLETED FAILED STANDBY"),
        ("watch", "first", "COMPLETED FAILED STANDBY"),
        ("first", "wait", "STANDBY"),
        ("first", "retry", "FAILED"),
        ("first", "end", "COMPLETED"),
    }
    until(lambda: ways(editor) == third, lambda: editor.text)
    until(lambda: "limit: 2 min" in editor.text, lambda: editor.text)


def test_f12_leads_to_the_definition(edit: Edit, visit: Visit) -> None:
    page = visit(edit("drugs_distribution_timer"))
    lines = text_of(page).locator(".cm-line")
    at = text_of(page).locator(".cm-activeLine")
    lines.filter(has_text="retry -> allocate").click(position={"x": 30, "y": 8})
    page.keyboard.press("F12")
    expect(at).to_have_text("  retry = PriorityManager(max_attempts: 3)")
    page.keyboard.press("F12")
    expect(page.get_by_text("This is its definition.")).to_be_visible()
    # a hook is declared here, and written there
    lines.filter(has_text="modifier limit_trip").click(position={"x": 115, "y": 8})
    page.keyboard.press("F12")
    code = page.get_by_role("textbox", name="hooks.py: your own code")
    expect(code).to_be_focused()
    expect(code.locator(".cm-activeLine")).to_contain_text("async def limit_trip(")
    page.keyboard.press("F1")
    expect(page.get_by_role("dialog")).to_contain_text("to the definition of a name")


def test_its_hook_is_written_in_the_editor(edit: Edit, visit: Visit) -> None:
    editor = edit("drugs_distribution_timer", without="hooks.py")
    page = visit(editor)
    block(page, "limit").locator(".face").click()
    page.get_by_role("button", name="Write its code: limit_trip").click()
    code = page.get_by_role("textbox", name="hooks.py: your own code")
    expect(code).to_contain_text("def limit_trip(")
    # what is at hand is told beside it
    given = page.get_by_role("region", name="What you can use in a hook")
    given.get_by_text("context", exact=True).click()
    expect(given.get_by_role("button", name="context.trip_ended")).to_be_visible()
    expect(code).to_be_visible()
    for line in ("does nothing yet", "await context.trip_ended"):  # what the stub does
        code.locator(".cm-line", has_text=line).last.click()
        page.keyboard.press("Control+Shift+K")
    code.locator(".cm-line", has_text="return mission.status").last.click()
    page.keyboard.press("Home")
    page.keyboard.press("Enter")
    page.keyboard.press("ArrowUp")
    complete(page, "if not await context.trip_", "trip_ended")
    complete(page, "(mission.curr", "current")
    page.keyboard.insert_text(", within=limit):")
    page.wait_for_timeout(500)  # a list that opened now would take the Enter
    page.keyboard.press("Enter")  # goes in by itself
    complete(page, "return Status.FAI", "FAILED")
    wanted = """\
    if not await context.trip_ended(mission.current, within=limit):
        return Status.FAILED
    return mission.status
"""
    until(lambda: wanted in editor.hooks, lambda: editor.hooks)
