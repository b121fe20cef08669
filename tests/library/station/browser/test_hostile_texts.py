"""Script, marks and endless names in every text: they are shown as they are, and nothing runs."""

from __future__ import annotations

from typing import Any

from playwright.sync_api import Page, expect

from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.steps import open_page, sees_all, start

SCRIPT = "<img src=x onerror=window.ran=1>"
HOSTILE = (
    SCRIPT,
    "</script><script>window.ran=1</script>",
    "\"'><svg onload=window.ran=1>",
    "javascript:window.ran=1",
    "{{7*7}} ${7*7} %s %n",
    "&lt;b&gt; &amp;",
)


def mission(number: int, text: str) -> dict[str, Any]:
    """Return a mission with a text in each place that holds one."""
    item = {"name": text, "mass": "1 g"}
    places = {"measure": [3.0, 5.0], "pick_item": [2.5, 3.0], "release_item": [3.0, 5.0]}
    trips = [
        {
            "key": f"{action}-{number}",
            "name": f"{text} {action}",
            "action": action,
            "target": place,
            "parameters": {"quantity": text} if action == "measure" else {},
            "item": None if action == "measure" else item,
        }
        for action, place in places.items()
    ]
    return {"key": f"mission-{number}", "name": text, "trips": trips}


def nothing_ran(page: Page) -> None:
    """No script of theirs ran, and no element is theirs."""
    assert page.evaluate("() => window.ran === undefined")
    assert page.evaluate("() => document.querySelectorAll('img[onerror], svg[onload]').length") == 0
    types = page.evaluate("() => [...document.scripts].map((one) => one.type)")
    assert types == ["importmap", "module"]


def test_script_in_every_text_is_shown_as_text_and_never_runs(serve: Serve, visit: Visit) -> None:
    """In the plan, in the flight, in the console, and in what is said of commands."""
    station = serve("drugs_distribution", "--speed", "60")
    station.plan([mission(number, text) for number, text in enumerate(HOSTILE)])
    page = visit(station)
    for text in HOSTILE:
        expect(page.get_by_text(text, exact=True).first).to_be_visible()
    page.get_by_text(HOSTILE[1], exact=True).first.dblclick()  # opens its trips
    expect(page.get_by_role("tab", name="Trips")).to_have_attribute("aria-selected", "true")
    nothing_ran(page)
    start(page)
    open_page(page, "Monitor")
    sees_all(page, "Completed", HOSTILE)
    page.get_by_role("button", name=SCRIPT).first.click()
    nothing_ran(page)
    page.get_by_role("tab", name="Console").click()
    expect(page.get_by_role("log")).to_contain_text(SCRIPT)
    for name in ("Missions", "Trips", "Monitor", "Help"):
        open_page(page, name)
        nothing_ran(page)
