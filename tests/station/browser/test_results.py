"""The Monitor says of each result what it is, in which unit, where, when, and of which trip."""

from __future__ import annotations

import re
from dataclasses import replace

from playwright.sync_api import expect

from tests.station.browser.conftest import Serve, Visit
from tests.station.browser.exercise import put_in
from tests.station.browser.steps import A_FLIGHT, sees_all, start
from tests.station.browser.test_monitor import FIELD, panel


def test_a_measurement_is_listed_with_what_where_when_and_for_whom(
    serve: Serve, visit: Visit
) -> None:
    station = put_in(serve("drugs_distribution", "--speed", "60"))
    page = visit(station)
    start(page)
    panel(page, "Results").get_by_role("button", name="Measurements").click()
    lines = panel(page, "Results").get_by_role("row")
    line = lines.filter(has_text="15, 1.5 m")
    expect(line).to_have_text(
        re.compile(r"^temperature\d+(\.\d+)? °C.*\d+:\d\d15, 1.5 mMission 2trip 2$"),
        timeout=A_FLIGHT,
    )
    expect(lines.first).to_have_text("MeasuredNewestHow it wentWhenWhereFor")
    expect(panel(page, "Results").get_by_role("button", name="Other actions")).to_have_count(0)


def test_what_the_apps_own_actions_return_is_listed_as_such_with_their_parameters(
    serve: Serve, visit: Visit
) -> None:
    page = visit(serve("alfalfa", "--missions", str(FIELD), "--speed", "30"))
    start(page)
    results = panel(page, "Results")
    others = results.get_by_role("button", name=re.compile(r"^Other actions [1-9]"))
    others.click(timeout=A_FLIGHT)
    expect(results.get_by_role("listitem").last).to_contain_text(
        re.compile(r"trip .+: pollinate, dose 20 mg, at [\d., ]+ m; it returned 0\.00002")
    )
    expect(results.get_by_role("button", name="Measurements 0")).to_be_visible()


def test_a_number_of_many_digits_is_shown_as_it_is(serve: Serve, visit: Visit) -> None:
    station = serve("drugs_distribution", "--speed", "60")
    station.end()
    fleet = station.folder / "fleet.toml"
    text = station.app.fleet.read_text().replace("temperature = 21.5", "temperature = 12345.0")
    fleet.write_text(text.replace("image =", "# image ="))
    station.app = replace(station.app, fleet=fleet)
    station.start()
    put_in(station)
    page = visit(station)
    start(page)
    panel(page, "Results").get_by_role("button", name="Measurements").click()
    sees_all(page, "Completed")
    results = station.get("/api/results.json")
    measured = [one["value"] for one in results if one["kind"] == "measurement"]
    assert measured
    for value in measured:  # sensors err: what it is, only the station knows
        shown = panel(page, "Results").get_by_role("row").filter(has_text=f"{value:.6g} °C")
        expect(shown.first).to_be_visible()
