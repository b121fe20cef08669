"""Hours of the day as instants, by the rules of a zone: the one place that knows when an hour comes.

An hour that a day skips, as its clocks are put forward, is the first instant after that. Of an hour that
comes twice, as they are put back, the first is taken.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping
from contextlib import suppress
from datetime import UTC, date, datetime, time, timedelta, tzinfo
from math import ceil, floor, isfinite
from typing import Any

DAY = 86_400.0
_NEXT = timedelta(days=1)
_BEYOND = OverflowError, ValueError, OSError
"""What calendars raise of moments that are in no year of theirs: then days have 24 hours."""


def zone_of(name: str) -> tzinfo | None:
    """Return a zone, as "Europe/Rome" names one; None, that of this computer, for ""; raise `ValueError`."""
    if name in ("", "UTC"):
        return UTC if name else None
    from zoneinfo import ZoneInfo, available_timezones  # slow, and rarely needed

    try:
        return ZoneInfo(name)
    except (KeyError, ValueError, OSError):
        if not available_timezones():
            raise ValueError("is not known here, nor any other: pip install tzdata") from None
        raise ValueError('is no zone of the IANA database: write it like "Europe/Rome"') from None


def day_of(text: str) -> date:
    """Read a date; raise `ValueError`."""
    try:
        day = date.fromisoformat(text)
    except ValueError:
        raise ValueError('is no date: write it like "2027-03-28"') from None
    if not 1970 <= day.year <= 9000:
        raise ValueError("is not in the years from 1970 to 9000")
    return day


def beginning(day: date | None, start: float | None, zone: str | None) -> Mapping[str, Any]:
    """Return when a simulation has `began` that begins on a day, at an hour, and in which `zone`.

    Without a day and a zone it is a day like any other, of 24 hours; with a zone alone it is today.
    """
    if day is None and zone is None:
        return {"began": start or 0.0, "zone": "UTC"}
    hours = Hours(zone=zone or "")
    day = day or datetime.now(zone_of(zone or "")).date()
    return {"began": hours.on(day, start or 0.0), "zone": zone or ""}


class Hours:
    """When hours of the day come, in seconds since an app's start, by the clock of its place."""

    def __init__(self, began: float = 0.0, zone: str = "UTC") -> None:
        """`began`: when the app started, in seconds since 1970; raise `ValueError` for an unknown zone."""
        self.began = began
        self._zone = zone_of(zone)

    def shown(self, moment: float) -> datetime:
        """Return what clocks show at a moment."""
        return datetime.fromtimestamp(self.began + moment, self._zone).astimezone(self._zone)

    @property
    def start(self) -> str:
        """When the app started, with its date; empty: a simulation of any day."""
        return "" if self.began < DAY else self.shown(0.0).isoformat(" ", "seconds")

    def said(self, moment: float, now: float = 0.0) -> str:
        """Return when a moment is for people: its hour and zone, and its date if that is another than now's."""
        then = self.shown(round(self.began + moment) - self.began)
        today = self.shown(now).date()
        clock = f"{then:%H:%M:%S}".removesuffix(":00")
        if not self.start:
            days = (then.date() - today).days
            return f"{clock} on day {days + 1}" if days else clock
        return f"{clock} {then:%Z}" + (f" on {then:%Y-%m-%d}" if then.date() != today else "")

    def on(self, day: date, hour: float) -> float:
        """Return when it is an hour, in seconds after midnight, on a day."""
        first, second = self._both(day, hour)
        if first > second:  # clocks jump over it, somewhere between these two
            after = self._ahead(first)
            span = range(floor(second), ceil(first) + 1)
            first = float(span[bisect_left(span, True, key=lambda t: self._ahead(t) == after)])
        return first - self.began

    def day(self, hour: float, since: float) -> date:
        """Return the day on which it is an hour for the first time from a moment on."""
        day = self.shown(since).date() - _NEXT  # midnight may be among what clocks jump over
        while self.on(day, hour) < since or self._is_left_out(day):
            day += _NEXT
        return day

    def next(self, hour: float, since: float) -> float:
        """Return when it is an hour for the first time from a moment on."""
        try:
            return self.on(self.day(hour, since), hour)
        except _BEYOND:
            return since + (hour - since) % DAY

    def again(self, first: float, every: float, since: float) -> float:
        """Return the first moment from `since` on that is a multiple of `every` after the first.

        Whole days keep the first one's hour; anything else is as much time.
        """
        count = (since - first) / every
        if not isfinite(count):
            return since  # it is shorter than any number can say
        count = ceil(round(count, 9))
        if every % DAY == 0.0:
            with suppress(*_BEYOND):
                return self._same_hour(first, every, max(count - 1, 1), since)
        return first + count * every

    def _same_hour(self, first: float, every: float, count: int, since: float) -> float:
        shown = self.shown(first)
        hour = (shown.replace(tzinfo=None) - datetime.combine(shown, time())).total_seconds()
        while (then := self.on(shown.date() + count * timedelta(seconds=every), hour)) < since:
            count += 1
        return then

    def _both(self, day: date, hour: float) -> tuple[float, float]:
        """Return when it is an hour the first and the second time; the other way round if it never is."""
        shown = datetime.combine(day, time(), self._zone) + timedelta(seconds=hour)
        return shown.timestamp(), shown.replace(fold=1).timestamp()

    def _ahead(self, instant: float) -> timedelta | None:
        return datetime.fromtimestamp(instant, self._zone).astimezone(self._zone).utcoffset()

    def _is_left_out(self, day: date) -> bool:
        """Return whether a day is in no calendar of the zone: it has crossed the date line."""
        first, second = self._both(day, DAY / 2)
        return first - second >= DAY
