"""Hours of the day are instants by the rules of a zone."""

from __future__ import annotations

import json
from datetime import datetime
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

import pytest

from pluto_fleet.process import wall_clock
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.process.wall_clock import WallClock
from pluto_fleet.shared.time.hours import DAY, Hours, beginning, day_of, zone_of
from tests.hours.virtual import ZONES, Case
from tests.kit import apps
from tests.kit.living import Living, enterable
from tests.library.station.jumping import JumpingLoop

HOUR = 3_600.0


def hours(start: str, zone: str) -> Hours:
    return Hours(datetime.fromisoformat(start).replace(tzinfo=ZoneInfo(zone)).timestamp(), zone)


@pytest.mark.parametrize("zone", ZONES)
def test_missions_set_out_around_a_change_as_the_zone_says(zone: str) -> None:
    """A small share of `python -m tests.hours`."""
    wrong = [Case(zone, number).wrong() for number in range(8)]
    assert wrong == [[]] * 8


@pytest.mark.parametrize(
    ("start", "zone", "hour", "seconds"),
    [
        ("2027-03-28 01:59:30", "Europe/Rome", 3 * HOUR + 60.0, 90.0),
        ("2027-03-28 01:59:30", "Europe/Rome", 2.5 * HOUR, 30.0),  # there is none
        ("2027-10-31 02:29:30", "Europe/Rome", 2.5 * HOUR, 30.0),  # it comes again an hour later
        ("2027-10-31 02:30:30", "Europe/Rome", 2.5 * HOUR, 25 * HOUR - 30.0),
        ("2018-11-03 23:59:30", "America/Sao_Paulo", 0.5 * HOUR, 30.0),
        ("2011-12-29 12:00:00", "Pacific/Apia", 10 * HOUR, 22 * HOUR),  # without the 30th
    ],
)
def test_an_hour_that_is_left_out_or_comes_twice_is_settled(
    start: str, zone: str, hour: float, seconds: float
) -> None:
    assert hours(start, zone).next(hour, 0.0) == seconds


def test_rounds_of_whole_days_keep_their_hour_and_others_their_time() -> None:
    rome = hours("2027-03-27 08:00:00", "Europe/Rome")
    assert rome.again(0.0, DAY, 60.0) == 23 * HOUR
    assert rome.again(0.0, 2 * DAY, 60.0) == 47 * HOUR
    assert rome.again(0.0, DAY / 2, 13 * HOUR) == 24 * HOUR


def test_hours_are_said_with_their_zone_and_another_day_with_its_date() -> None:
    rome = hours("2027-03-28 01:00:00", "Europe/Rome")
    assert (rome.said(HOUR), rome.said(HOUR + 5.0)) == ("03:00 CEST", "03:00:05 CEST")
    assert rome.said(DAY) == "02:00 CEST on 2027-03-29"
    assert (Hours().said(HOUR), Hours().said(DAY + HOUR)) == ("01:00", "01:00 on day 2")
    assert (rome.start, Hours().start) == ("2027-03-28 01:00:00+01:00", "")


def test_a_simulation_begins_where_it_is_told_to() -> None:
    assert beginning(None, 60.0, None) == {"began": 60.0, "zone": "UTC"}
    at = beginning(day_of("2018-11-04"), None, "America/Sao_Paulo")  # a day without its midnight
    assert datetime.fromtimestamp(at["began"], ZoneInfo(at["zone"])).hour == 1


@pytest.mark.parametrize("name", ["Europe/Rum", "../etc/passwd", "Europe", "\0", "x" * 300])
def test_what_is_no_zone_is_said_to_be_none(name: str) -> None:
    with pytest.raises(ValueError, match='is no zone of the IANA database: write it like "Europe'):
        zone_of(name)


def test_a_computer_that_knows_no_zones_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def none(name: str) -> None:
        raise ZoneInfoNotFoundError(name)

    monkeypatch.setattr("zoneinfo.ZoneInfo", none)
    monkeypatch.setattr("zoneinfo.available_timezones", set)
    with pytest.raises(ValueError, match="pip install tzdata"):
        zone_of("Europe/Rome")


@pytest.mark.parametrize(
    ("drift", "launched"),
    [
        (600.0, 400.0),  # the clock was set forward, or the computer slept
        (-600.0, 1_600.0),
        (3_000.0, 100.0),  # its hour is over
        (30.5 * DAY, 12 * HOUR + 1_000.0),  # it was wrong by a month: the next such hour
    ],
)
@pytest.mark.parametrize("crashes", [False, True])
def test_a_clock_that_moves_does_not_move_an_hour(
    drift: float, launched: float, crashes: bool
) -> None:
    """`at`, a window and a deadline are all at the same hour; what was promised stays with its day."""
    missions = [
        apps.mission("at", apps.trip("1", 3.0), at=1_000.0),
        apps.mission("due", apps.trip("1", 3.0), at=2 * HOUR, promises={"deadline": "00:16:40"}),
        apps.mission("delay", apps.trip("1", 3.0, delay=200.0)),
        apps.mission("opens", apps.trip("1", 3.0), promises={"opens": "00:16:40"}),
    ]
    homes = [(0.5 + x, 0.5, 0.0) for x in range(4)]
    living = Living(enterable(clock=True), *missions, on=apps.fleet(*homes))
    if crashes:
        living.crash(50.0)
    living.at(100.0, lambda: living.life.driver.tell({"drift": drift}))
    living.run(until=3 * DAY)
    came = {str(one["mission"]): float(str(one["t"])) for one in living.named("trip.launched")}
    promised = launched if drift < DAY else 100.0
    assert came["delay"] == 200.0
    assert came["at"] == pytest.approx(launched, abs=5.0)
    assert [came["opens"], *living.times("mission.late")] == pytest.approx([promised] * 2, abs=5.0)


def test_the_drift_of_a_clock_is_what_it_was_set_by(monkeypatch: pytest.MonkeyPatch) -> None:
    loop = JumpingLoop()
    ahead = [0.0]
    seen = list[object]()
    monkeypatch.setattr(wall_clock, "now", lambda: 1_000.0 + loop.now + ahead[0])

    async def look() -> None:
        clock = WallClock(RealTime(5.0), {"began": None, "drift": 0.0})
        for ahead[0] in (0.0, 600.0, 600.01, -30.0):
            seen.append((clock.moved(), round(clock.drift)))
        later = WallClock(RealTime(begin=50.0), json.loads(json.dumps(clock.data)))
        seen.append(round(later.drift))

    loop.run_until_complete(look())
    loop.close()
    assert seen == [(False, 0), (True, 600), (False, 600), (True, -30), -80]
