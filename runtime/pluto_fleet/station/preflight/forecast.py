"""A forecast of a Start, made of its runs."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, floor
from statistics import median
from typing import TYPE_CHECKING, Any

from ...flight.simulate import has_traffic
from ...shared.domain.text import counted, duration, percent
from ...shared.fleet.reach import docked
from ..charging import ready_in
from ..words import words
from .bottlenecks import bottlenecks
from .question import UNTIL
from .runs import Needs, Rehearsed, Run, telling

if TYPE_CHECKING:
    from ...shared.domain.model import Mission
    from ..wire import Forecast, MissionForecast, Readiness, Words
    from .present import Present
    from .question import Question

HIGH = 0.95
"""The share of runs that end before what is called high."""


def without_runs(question: Question | None, revision: int, problems: list[Words]) -> Forecast:
    """Return the forecast of a Start that would be refused."""
    return {
        "revision": revision,
        "runs": 0,
        "world": "alone",
        "median": None,
        "high": None,
        "missions": [],
        "drones": [] if question is None else readiness(question, Needs({}, {})),
        "lowest_battery": None,
        "bottlenecks": [],
        "assumed": [],
        "problems": problems,
        "rehearsal": None,
    }


def forecast(
    question: Question,
    keys: Sequence[str],
    needs: Needs,
    runs: Sequence[Run],
    rehearsed: Rehearsed | None,
    rehearsal: str | None,
    problems: list[Words],
) -> Forecast:
    """Return what runs say; there is at least one. `keys` are those of the missions."""
    drones = readiness(question, needs)
    times = sorted(run.seconds for run in telling(runs))
    ends = question.until is None
    waits = [] if rehearsed is None else bottlenecks(question, rehearsed.waits)
    return {
        "revision": question.revision,
        "runs": len(runs),
        "world": "traffic" if has_traffic(question.fleet) else "alone",
        "median": median(times) if ends else None,
        "high": percentile(times, HIGH) if ends else None,
        "missions": [
            _mission(mission, key, runs)
            for mission, key in zip(question.missions, keys, strict=True)
        ],
        "drones": drones,
        "lowest_battery": min(
            (run.battery for run in runs if run.battery is not None), default=None
        ),
        "bottlenecks": waits,
        "assumed": _assumed(question, rehearsed),
        "problems": [*problems, *_given_up(runs)],
        "rehearsal": rehearsal,
    }


def percentile(ordered: Sequence[float], share: float) -> float:
    """Return a percentile, interpolated between two neighbours."""
    place = share * (len(ordered) - 1)
    below, above = ordered[floor(place)], ordered[ceil(place)]
    return min(below + (above - below) * (place - floor(place)), above)


def readiness(question: Question, needs: Needs) -> list[Readiness]:
    """Return how the drones stand before the Start."""
    kinds = {category.name: category for category in question.app.categories}
    entries = {one.id: one for one in question.fleet.drones}
    found: list[Readiness] = []
    for one in question.present:
        kind, home = kinds[entries[one.id].category], entries[one.id].home
        wanted = needs.levels.get(one.id, kind.reserve)
        seconds = ready_in(kind, one.battery, wanted, docked=docked(one.at, home))
        is_for_later = one.id in needs.why and one.id not in needs.levels
        why = one.out or _why_not(one, wanted, seconds, needs, docked=docked(one.at, home))
        found.append(
            {
                "id": one.id,
                "battery": one.battery if one.known else None,
                "ready": why is None or (one.out is None and is_for_later and not seconds),
                "why": why,
                "ready_in": None if one.out is not None else seconds,
                "assumed": one.assumed,
            }
        )
    return found


def _why_not(
    one: Present, wanted: float, seconds: float | None, needs: Needs, *, docked: bool
) -> Words | None:
    if one.id in needs.why:
        return words("preflight.cannot", needs.why[one.id], why=needs.why[one.id])
    if one.battery >= wanted:
        return None
    has = f"its battery has {percent(one.battery)}"
    if wanted > 1.0:
        return words(
            "preflight.too-far", "no battery lasts for any of these missions and the way home"
        )
    facts = {"battery": one.battery, "needs": wanted}
    if seconds is None and docked:
        text = f"{has}, any of these missions takes {percent(wanted)}, and nothing charges it"
        return words("preflight.uncharged", text, **facts)
    if seconds is None:
        text = (
            f"{has}, any of these missions takes {percent(wanted)}: it flies home first to charge"
        )
        return words("preflight.low-away", text, **facts)
    text = f"{has}, any of these missions takes {percent(wanted)}: in {duration(seconds)}"
    return words("preflight.charges", text, ready_in=seconds, **facts)


def _mission(mission: Mission[Any], key: str, runs: Sequence[Run]) -> MissionForecast:
    ends = [run.ends[mission.name] for run in runs]
    times = sorted(end.at for end in ends if end.completed and end.at is not None)
    return {
        "key": key,
        "name": mission.name,
        "trips": len(mission.trips),
        "median": median(times) if times else None,
        "high": percentile(times, HIGH) if times else None,
        "late": sum(end.late for end in ends) / len(ends),
        "fails": sum(end.at is not None and not end.completed for end in ends) / len(ends),
    }


def _assumed(question: Question, rehearsed: Rehearsed | None) -> list[Words]:
    found = []
    if question.beside:
        text = (
            f"{counted(len(question.beside), 'mission')} that fly already are flown to their end,"
            " by drones that are supposed to be back in their docks"
        )
        found.append(words("preflight.beside", text, missions=len(question.beside)))
    if question.until is not None:
        text = f"some missions repeat until they are stopped: they are flown for {duration(UNTIL)}"
        found.append(words("preflight.endless", text, seconds=UNTIL))
    if question.is_simpler:
        text = (
            "drones are not kept apart in these runs, as that takes too long to work out for so many:"
            " it will take longer than they say"
        )
        found.append(words("preflight.not-apart", text))
    if rehearsed is not None and rehearsed.trouble:
        text = f"there is no rehearsal: {rehearsed.trouble}"
        found.append(words("preflight.no-rehearsal", text, why=rehearsed.trouble))
    return found


def _given_up(runs: Sequence[Run]) -> list[Words]:
    found = [run.given_up for run in runs if run.given_up]
    if not found:
        return []
    why = found[0].partition(";")[0]
    text = f"{len(found)} of {counted(len(runs), 'run')} were given up: {why}"
    return [words("preflight.given-up", text, runs=len(found), why=why)]
