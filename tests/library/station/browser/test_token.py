"""Where others than this machine's users may come, one must know the token that was printed."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import expect

from tests.kit.browser import Watch
from tests.kit.station import until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import put_in
from tests.library.station.browser.steps import missions_listed, open_page, row_of, start


@pytest.mark.long
def test_one_browser_is_told_the_token_once_until_it_is_told_to_forget_it(
    serve: Serve, visit: Visit, watch: Watch
) -> None:
    """The whole address may be pasted; then another tab knows it, too, and no cookie does."""
    watch.expected += ["401"]
    station = put_in(serve("drugs_distribution", "--name", "ward.example"))
    page = visit(station, path="/")
    expect(page.get_by_role("heading")).to_contain_text("asks for its token")
    expect(page.get_by_text("Mission 1")).to_have_count(0)
    for given in ("wrong", station.url):
        page.get_by_label("Address or token").fill(given)
        page.get_by_role("button", name="Open the station").click()
        if given == "wrong":
            refused = page.get_by_role("alert").filter(has_text="no such token")
            expect(refused).to_be_visible()
    expect(missions_listed(page)).to_have_count(3)
    context = page.context
    another = context.new_page()
    page.close()
    another.goto(f"http://127.0.0.1:{station.port}/")
    expect(missions_listed(another)).to_have_count(3)
    assert context.cookies() == []
    open_page(another, "Help")
    another.get_by_role("button", name="Forget the token").click()
    expect(another.get_by_role("heading")).to_contain_text("asks for its token")


COMMANDS = re.compile(
    "^(start|stop|resume|put away|add|new mission|set trips|delete|copy|import|undo|redo|retire|bring back"
    "|cut|slide|skip|pause|go on|cancel|seen|i have seen|let .* join|lost|crash|answer)",
    re.IGNORECASE,
)
"""How the names of buttons begin that change something."""


def test_who_may_only_watch_sees_all_and_no_button_that_commands(
    serve: Serve, visit: Visit, watch: Watch
) -> None:
    station = put_in(serve("drugs_distribution", "--name", "ward.example", "--speed", "2"))
    flier = visit(station)
    buttons = flier.get_by_role("button", name=COMMANDS)
    expect(buttons.filter(has_text="Stop: land now")).to_be_visible()  # so these names find some
    start(flier)
    page = visit(station, path=station.url_to_watch.partition(str(station.port))[2])
    open_page(page, "Monitor")
    assert "token" not in page.url
    row_of(page, "Mission 3").get_by_role("button", name="Mission 3").click()
    expect(row_of(page, "Mission 3")).to_contain_text("Flying")
    expect(page.get_by_text("You are watching")).to_be_visible()
    buttons = page.get_by_role("button", name=COMMANDS)
    expect(buttons).to_have_count(0)
    page.get_by_role("tab", name="Drones").click()
    page.get_by_role("listitem").get_by_role("button", name="cf1").click()
    expect(page.get_by_role("region", name="Drone cf1")).to_be_visible()
    expect(buttons).to_have_count(0)
    flier.get_by_role("button", name="Stop: land now").click()
    until(lambda: station.phase == "stopped", "all have landed")
    expect(page.get_by_role("banner").get_by_text("Stopped")).to_be_visible()
    for name in ("Missions", "Trips", "Results", "History", "Map"):
        open_page(page, name)
        expect(page.get_by_role("tabpanel", name=name, exact=True)).not_to_be_empty()
        expect(buttons).to_have_count(0)
