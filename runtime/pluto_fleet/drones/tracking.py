"""Things that move, as they are measured from outside: for who follows them, and for cameras that look at them.

A tracker is a user's class, named in the fleet file. It may invent tracks or yield nonsense: what is told of
them is bounded, and can be shown.
"""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable, Mapping
from dataclasses import dataclass, field
from math import isfinite
from time import monotonic
from typing import TYPE_CHECKING, Protocol

from ..shared.domain.model import Point, Sighting
from ..shared.domain.text import place, quoted
from ..shared.domain.values import is_name
from .source import Source

if TYPE_CHECKING:
    from ..shared.domain.airspace import Airspace


@dataclass(frozen=True, slots=True, kw_only=True)
class Track:
    """Where something was that moves."""

    id: str
    """By which it is known: as long as one thing is followed, the same."""
    at: Point
    """Metres, in the map's frame."""
    kind: str = ""
    """What it is, such as `person`; empty: that is not known."""
    time: float = field(default_factory=monotonic)
    """When it was there, by `time.monotonic()`."""


class Tracker(Protocol):
    """A system that sees what moves; the class is called with the table `[tracker]`."""

    def tracks(self) -> AsyncIterator[Track]:
        """Yield where things are, until cancelled: each twice a second or more, while it is seen.

        Metres, in the map's frame: places in another frame are converted here. What cannot be seen is left
        out, never given its last place again. The drones themselves are left out, too.

        Most simply an async generator: what it has opened it closes in its `finally`. If it ends or
        raises, it is called again a second later. Nothing in it may hold up the event loop.
        """


NEAR = 5.0
"""Metres around the map, and below its ground and above its ceiling, within which tracks are taken over."""
MOST = 100
"""How many tracks are known at a time."""
KNOWN = 2.0
"""Seconds without news after which a track is forgotten: another may take its place."""
EARLY = 0.1
"""Seconds by which a clock may be fast."""


class TrackFeed:
    """What one tracker says, in a running event loop."""

    def __init__(
        self,
        name: str,
        tracker: Tracker,
        airspace: Airspace,
        log: Callable[[str], object],
        clock: Callable[[], float] = monotonic,
    ) -> None:
        """`name`: its name in the fleet file."""
        self._airspace = airspace
        self._clock = clock
        self._source = Source(f"the tracker {name}", "tracks", tracker.tracks, self._hear, log)
        self._known: dict[str, Track] = {}
        self._news: dict[str, None] = {}
        """The tracks of which something is new since the last call."""
        self.start = self._source.start
        self.close = self._source.close

    def news(self) -> Mapping[str, object]:
        """Return where things are that were seen since the last call, and how many seconds `ago` that was."""
        now = self._clock()
        self._forget(now)
        told = {}
        for id in self._news:
            track = self._known[id]
            told[id] = {
                "kind": track.kind,
                "at": [*track.at],
                "ago": round(max(0.0, now - track.time), 3),
            }
        self._news.clear()
        return told

    def in_view(self, place: Point, width: float, height: float) -> tuple[Sighting, ...]:
        """Return what moves in a rectangle of the map around a place, by the last that is known."""
        self._forget(self._clock())
        return tuple(
            Sighting(track.id, track.kind, track.at)
            for track in self._known.values()
            if abs(track.at[0] - place[0]) <= width / 2
            and abs(track.at[1] - place[1]) <= height / 2
        )

    def _forget(self, now: float) -> None:
        """Forget what has had no news."""
        for id, track in [*self._known.items()]:
            if now - track.time > KNOWN:
                del self._known[id]
                self._news.pop(id, None)

    def _hear(self, one: object) -> None:
        track = self._checked(one)
        if track is None:
            return
        if track.id not in self._known and len(self._known) >= MOST:
            self._forget(self._clock())
            if len(self._known) >= MOST:
                self._say(f"sees more than {MOST} things that move: the others are left out")
                return
        last = self._known.get(track.id)
        if last is None or last.time < track.time:
            self._known[track.id] = track
            self._news[track.id] = None

    def _checked(self, one: object) -> Track | None:
        """Return a track of any copy of the class, with its time; None: it is none, and that is said."""
        id = getattr(one, "id", None)
        kind = getattr(one, "kind", "")
        if not is_name(id):
            self._say("gave what is no track: it has no id that can be shown")
            return None
        name = quoted(str(id))
        match getattr(one, "at", None):
            case (float() | int() as x, float() | int() as y, float() | int() as z):
                at = float(x), float(y), float(z)
            case _:
                self._say(f"gave {name} no place: at must be three numbers")
                return None
        if kind and not is_name(kind):
            self._say(f"gave {name} a kind that cannot be shown")
            return None
        if not all(map(isfinite, at)):
            self._say(f"gave {name} a place that is no number")
            return None
        if not self._is_near(at):
            self._say(f"sees {name} far from the map, at {place(at)}")
            return None
        now = self._clock()
        when = getattr(one, "time", now)
        if not isinstance(when, float | int) or not now - KNOWN <= when <= now + EARLY:
            self._say(f"gave {name} a time that is not now, by time.monotonic()")
            return None
        return Track(id=str(id), at=at, kind=str(kind or ""), time=float(when))

    def _is_near(self, at: Point) -> bool:
        width, depth = self._airspace.size
        x, y, z = at
        return (
            -NEAR <= x <= width + NEAR
            and -NEAR <= y <= depth + NEAR
            and -NEAR <= z <= self._airspace.ceiling + NEAR
        )

    def _say(self, sentence: str) -> None:
        self._source.say(f"{self._source.name} {sentence}")
