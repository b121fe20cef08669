"""Hours around the changes of a year, flown in virtual time, beside what `zoneinfo` says, minute by minute."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, date, datetime, time, timedelta
from functools import cache
from random import Random
from zoneinfo import ZoneInfo

from tests.kit import apps

MINUTE = timedelta(minutes=1)
DAY = timedelta(days=1)
ZONES = {
    "Europe/Rome": 2027,
    "America/Sao_Paulo": 2018,  # at midnight
    "Australia/Lord_Howe": 2027,  # by half an hour
    "Asia/Kathmandu": 2027,  # never
    "Pacific/Apia": 2020,
    "Europe/Dublin": 2027,  # winter is the change
    "Africa/Casablanca": 2027,  # around Ramadan
    "America/St_Johns": 2027,
    "Pacific/Chatham": 2027,
    "America/Nuuk": 2027,  # the evening before
    "Africa/Cairo": 2027,  # at midnight
    "America/Santiago": 2027,  # at midnight
}
"""With the year whose changes are flown."""
EVERY = (1800.0, 3600.0, 5400.0, 43_200.0, 86_400.0, 172_800.0)


@cache
def changes(zone: str) -> tuple[datetime, ...]:
    """Return the instants of a year at which a zone's clocks are changed; two days of one that never does."""
    year = ZONES[zone]
    place = ZoneInfo(zone)
    hours = [datetime(year, 1, 1, tzinfo=UTC) + timedelta(hours=n) for n in range(365 * 24)]
    shown = [one.astimezone(place).utcoffset() for one in hours]
    found = [hours[n] for n in range(1, len(hours)) if shown[n] != shown[n - 1]]
    return tuple(found) or (hours[1_000], hours[5_000])


def minutes(place: ZoneInfo, since: datetime) -> Iterator[tuple[datetime, datetime]]:
    """Yield what clocks show in the minute before and now, for each whole minute from an instant on."""
    at = (since + MINUTE - timedelta(microseconds=1)).replace(second=0, microsecond=0)
    while True:
        yield (at - MINUTE).astimezone(place), at.astimezone(place)
        at += MINUTE


def coming(hour: time, place: ZoneInfo, since: datetime) -> datetime:
    """Return when it is an hour next: the first of two, and right after the gap if clocks jump over it."""
    for before, now in minutes(place, since):
        last = before.replace(tzinfo=None)
        this = now.replace(tzinfo=None)
        jumped = {datetime.combine(day, hour) for day in (last.date(), this.date())}
        if (now.time() == hour and not now.fold) or any(last < one < this for one in jumped):
            return now.astimezone(UTC)
    raise AssertionError


def begins(day: date, place: ZoneInfo) -> datetime:
    """Return when a day begins."""
    since = datetime.combine(day, time(), UTC) - DAY
    return next(now.astimezone(UTC) for _, now in minutes(place, since) if now.date() >= day)


class Case:
    """One mission with an hour, drawn from a zone and a number; it is started up to two days before a change."""

    def __init__(self, zone: str, number: int) -> None:
        chance = Random(f"hours/{zone}/{number}")
        self.place = ZoneInfo(zone)
        self.zone = zone
        change = chance.choice(changes(zone))
        self.start = change - timedelta(seconds=chance.randrange(-7_200, 2 * 86_400))
        about = change.astimezone(self.place).replace(tzinfo=None)
        first, second = (about + MINUTE * chance.randrange(-150, 150) for _ in range(2))
        self.hour = first.time()
        self.closes = second.time()
        self.every = chance.choice(EVERY)
        self.kind = ("at", "window", "deadline", "every")[number % 4]
        if self.hour == self.closes:
            self.kind = "at"

    @property
    def promises(self) -> dict[str, str]:
        """What its plan promises."""
        opens = f"{self.hour:%H:%M}"
        due = f"{self.closes:%H:%M}"
        return {"window": {"opens": opens, "deadline": due}, "deadline": {"deadline": due}}.get(
            self.kind, {}
        )

    def due(self) -> datetime:
        """Return when it is due: an hour that has just come is the one of tomorrow."""
        return coming(self.closes, self.place, self.start + timedelta(microseconds=1))

    def expected(self) -> list[datetime]:
        """Return when it is to set out, and at last when it is late."""
        if self.kind == "deadline":
            return [self.due()]
        if self.kind == "window":
            due = self.due()
            day = due.astimezone(self.place).date() - (self.hour > self.closes) * DAY
            opens = coming(self.hour, self.place, begins(day, self.place))
            return [max(self.start, opens), due]
        starts = [coming(self.hour, self.place, self.start)]
        for n in (1, 2) if self.kind == "every" else ():
            since = timedelta(seconds=self.every)
            if since % DAY:
                starts.append(starts[0] + n * since)
                continue
            kept = starts[0].astimezone(self.place).time()
            then = starts[0]
            for _ in range(n * (since // DAY)):
                then = coming(kept, self.place, then + MINUTE)
            starts.append(then)
        return starts

    def flown(self) -> list[datetime]:
        """Return the same as it was flown."""
        of_day = timedelta(hours=self.hour.hour, minutes=self.hour.minute).total_seconds()
        ends = self.kind in ("window", "deadline")
        mission = apps.mission(
            "m",
            apps.trip("A", 3.0, delay=2 * 86_400.0 if self.kind == "deadline" else None),
            *([apps.trip("B", 3.0, delay=2 * 86_400.0)] if self.kind == "window" else []),
            at=None if ends else of_day,
            every=self.every if self.kind == "every" else None,
            repeat=2 if self.kind == "every" else 0,
            promises=self.promises,
        )
        fleet = replace(apps.fleet(), began=self.start.timestamp(), zone=self.zone)
        outcome = apps.flown(mission, on=fleet, clock=True, repeater=True)
        first = {"deadline": 0, "window": 1}.get(self.kind)
        times = [
            *apps.times(outcome, "trip.launched")[:first],
            *apps.times(outcome, "mission.late"),
        ]
        return [self.start + timedelta(seconds=one) for one in times]

    def wrong(self) -> list[str]:
        """Return in what the flight differs from what `zoneinfo` says."""
        expected = self.expected()
        flown = self.flown()
        if len(expected) == len(flown) and all(
            abs(a - b) < timedelta(milliseconds=2) for a, b in zip(expected, flown, strict=True)
        ):
            return []
        what = f"{self.kind} {self.hour:%H:%M}, {self.closes:%H:%M}, every {self.every:g} s"
        shown = [
            [f"{one.astimezone(self.place):%d %H:%M:%S %z}" for one in times]
            for times in ([self.start], expected, flown)
        ]
        return [f"{self.zone}: {what}; start, expected, flown: {shown}"]
