"""Several browsers look at one station: all see the same, and nothing that one draws is lost."""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from tests.kit.browser import Watch
from tests.kit.station import until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import names
from tests.library.station.browser.steps import (
    ANOTHER_WAS_QUICKER,
    add_mission,
    drag,
    holding_the_first,
    missions_listed,
    open_page,
)


def test_what_one_draws_the_other_sees(serve: Serve, visit: Visit, watch: Watch) -> None:
    watch.expected.append(ANOTHER_WAS_QUICKER)  # the trip may still be on its way to the other
    station = serve()
    one, other = visit(station), visit(station)
    add_mission(one, "From here")
    drag(one, "measure", (3.0, 5.0))
    expect(missions_listed(other)).to_have_text(["From here"])
    add_mission(other, "From there")
    open_page(one, "Missions")
    expect(missions_listed(one)).to_have_text(["From here", "From there"])
    until(lambda: len(station.missions) == 2, "both are kept")


@pytest.mark.long
def test_what_two_draw_in_one_moment_is_kept_of_both(
    serve: Serve, visit: Visit, watch: Watch
) -> None:
    watch.expected.append(ANOTHER_WAS_QUICKER)
    station = serve()
    one, other = visit(station), visit(station)
    held = holding_the_first(one)
    with one.expect_request(lambda request: request.method == "PUT"):
        add_mission(one, "From here")
    add_mission(other, "From there")
    until(lambda: names(station) == ["From there"], "the quicker one is kept")
    assert watch.complaints == []
    held[0].continue_()
    for page in (one, other):
        open_page(page, "Missions")
        expect(missions_listed(page)).to_have_text(["From there", "From here"])
    until(lambda: names(station) == ["From there", "From here"], "both are kept")
    # at least once: on a slow machine a page saves what is drawn there in more than one go
    assert {ANOTHER_WAS_QUICKER in one for one in watch.complaints} == {True}
