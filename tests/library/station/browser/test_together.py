"""Several browsers look at one station: all see the same, and what two ask for is done once."""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor

import pytest
from playwright.sync_api import Route, expect

from tests.kit.browser import Watch
from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import COMPLETED, DONE, put_in
from tests.library.station.browser.steps import (
    ANOTHER_WAS_QUICKER,
    add_mission,
    drag,
    holding_the_first,
    missions_listed,
    open_page,
    row_of,
    sees_all,
    start,
)


def test_what_one_draws_the_other_sees(serve: Serve, visit: Visit, watch: Watch) -> None:
    watch.expected.append(ANOTHER_WAS_QUICKER)  # the trip may still be on its way to the other
    station = serve("drugs_distribution")
    one, other = visit(station), visit(station)
    add_mission(one, "From here")
    drag(one, "measure", (3.0, 5.0))
    expect(missions_listed(other)).to_have_text(["From here"])
    add_mission(other, "From there")
    open_page(one, "Missions")
    expect(missions_listed(one)).to_have_text(["From here", "From there"])
    until(lambda: len(station.missions) == 2, "both are kept")


def test_what_two_draw_in_one_moment_is_kept_of_both(
    serve: Serve, visit: Visit, watch: Watch
) -> None:
    watch.expected.append(ANOTHER_WAS_QUICKER)
    station = serve("drugs_distribution")
    one, other = visit(station), visit(station)
    held = holding_the_first(one)
    with one.expect_request(lambda request: request.method == "PUT"):
        add_mission(one, "From here")
    add_mission(other, "From there")
    until(lambda: _names(station) == ["From there"], "the quicker one is kept")
    assert watch.complaints == []
    held[0].continue_()
    for page in (one, other):
        open_page(page, "Missions")
        expect(missions_listed(page)).to_have_text(["From there", "From here"])
    until(lambda: _names(station) == ["From there", "From here"], "both are kept")
    # at least once: on a slow machine a page saves what is drawn there in more than one go
    assert {ANOTHER_WAS_QUICKER in one for one in watch.complaints} == {True}


def _names(station: Station) -> list[str]:
    return [mission["name"] for mission in station.missions]


def test_two_who_press_start_at_once_start_once_and_see_the_same(
    serve: Serve, visit: Visit
) -> None:
    station = put_in(serve("drugs_distribution", "--speed", "60"))
    one, other = visit(station), visit(station)
    held: list[Route] = []
    for page in (one, other):
        page.route("**/api/start", lambda route: held.append(route))
        with page.expect_request("**/api/start"):
            start(page)
    for route in held:
        route.continue_()
    for page in (one, other):
        open_page(page, "Monitor")
        sees_all(page, "Completed")
    assert len(held) == 2
    assert station.statuses() == COMPLETED
    assert station.done() == DONE
    assert len(station.journals()) == 1


def test_many_starts_in_one_moment_start_once(serve: Serve) -> None:
    """Each with an id of its own: as from so many browsers."""
    station = put_in(serve("drugs_distribution"))
    with ThreadPoolExecutor(8) as browsers:
        answers = list(
            browsers.map(lambda n: station.post("/api/start", {"id": f"start-{n}"}), range(8))
        )
    assert {status for status, _ in answers} <= {200, 409, 429}, json.dumps(answers)
    assert sum(status == 200 for status, _ in answers) >= 1
    assert len(station.journals()) == 1
    until(lambda: list(station.statuses()) == list(COMPLETED), "each of them flies, once")


@pytest.mark.long  # a whole flight; test_monitor.py pauses one
def test_a_mission_that_one_pauses_is_paused_for_the_other_who_lets_it_go_on(
    serve: Serve, visit: Visit
) -> None:
    station = put_in(serve("drugs_distribution"))
    one, other = visit(station), visit(station)
    start(one)
    open_page(other, "Monitor")
    row_of(one, "Mission 1").get_by_role("button", name="Mission 1").click()
    one.get_by_role("button", name="Pause", exact=True).click()
    expect(row_of(other, "Mission 1")).to_contain_text("Paused")
    row_of(other, "Mission 1").get_by_role("button", name="Mission 1").click()
    other.get_by_role("button", name="Go on", exact=True).click()
    for page in (one, other):
        sees_all(page, "Completed")
