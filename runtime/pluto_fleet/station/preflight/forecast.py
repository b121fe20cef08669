"""A forecast of a Start, made of its runs, and what holds it up."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from statistics import median
from typing import TYPE_CHECKING, Any

from ...flight.simulate import has_traffic
from ...report.spread import percentile
from ...shared.domain.actions import PICK
from ...shared.domain.text import counted, duration, mass, percent
from ...shared.fleet.reach import docked
from ..rows import words
from .question import UNTIL
from .runs import Flown, Needs, Rehearsed, Run, telling

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from ...shared.domain.model import Mission
    from ..wire import Forecast, MissionForecast, Readiness, Words
    from .question import Present, Question
    from .rehearsal import Waits


NOTABLE = 0.1
"""The share of a run in which a mission must wait for something, for that to be said."""

FEW = 0.5
"""The share of the fleet up to which its able drones are few."""


def bottlenecks(question: Question, waits: Waits) -> list[Words]:
    """Return what holds the plan up, the most important first."""
    return [
        *_low(question, waits),
        *_few(question, waits),
        *_charging(question, waits),
        *_busy(question, waits),
        *_room(question, waits),
    ]


def _low(question: Question, waits: Waits) -> Iterator[Words]:
    """Yield that missions wait at first, as batteries are too low."""
    if waits.first is None or not waits.first[0]:
        return
    number, low = waits.first
    short = [one for one in question.present if one.id in low]
    if not short:
        return
    level = max(low.values())
    every = [question.ready_in(one, low[one.id]) for one in short]
    soonest = min((seconds for seconds in every if seconds is not None), default=None)
    first = "" if soonest is None else f", the first is ready in about {duration(soonest)}"
    are = "is" if len(short) == 1 else "are"
    text = f"{_wait(number)}: {counted(len(short), 'drone')} {are} below {percent(level)}{first}"
    facts = {} if soonest is None else {"ready_in": soonest}
    yield words("preflight.low", text, missions=number, drones=len(short), level=level, **facts)


def _few(question: Question, waits: Waits) -> Iterator[Words]:
    """Yield that missions wait for the few drones that can do what they need."""
    found: dict[tuple[tuple[str, ...], str], list[float]] = defaultdict(list)
    names = {**waits.busy, **waits.low}
    both = {name: waits.busy.get(name, 0.0) + waits.low.get(name, 0.0) for name in names}
    for name in _notable(waits, both):
        able = waits.few.get(name)
        if able and len(able) <= FEW * len(question.flown.drones):
            action, kilograms = waits.lacks[name]
            found[able, action].append(kilograms)
    for (able, action), masses in found.items():
        number = len(masses)
        kilograms = min(masses)
        does = f"lift {mass(kilograms)}" if action == PICK else f"do {action}"
        who = "the one drone" if len(able) == 1 else f"the {len(able)} drones"
        wait = "waits" if number == 1 else "wait"
        of = counted(len(question.all), "mission")
        text = f"{number} of {of} {wait} for {who} that can {does}"
        yield words(
            "preflight.few-lift" if action == PICK else "preflight.few",
            text,
            missions=number,
            of=len(question.all),
            drones=list(able),
            action=action,
            mass=kilograms,
        )


def _charging(question: Question, waits: Waits) -> Iterator[Words]:
    """Yield that missions wait for batteries later on."""
    late = _notable(waits, waits.low)
    if late:
        mean = sum(waits.low[name] for name in late) / len(late)
        text = f"{_wait(len(late))} for batteries to be charged, {duration(mean)} on average"
        yield words("preflight.charging", text, missions=len(late), seconds=mean)


def _busy(question: Question, waits: Waits) -> Iterator[Words]:
    """Yield that missions wait, as all drones that could fly them do."""
    busy = [name for name in _notable(waits, waits.busy) if name not in waits.few]
    if busy:
        mean = sum(waits.busy[name] for name in busy) / len(busy)
        number = len(question.flown.drones)
        who = "the one drone is" if number == 1 else f"all {number} drones are"
        text = f"{_wait(len(busy))} {duration(mean)} on average: {who} busy then"
        yield words("preflight.busy", text, missions=len(busy), seconds=mean, drones=number)


def _room(question: Question, waits: Waits) -> Iterator[Words]:
    """Yield that missions wait, as no more drones may be in the air."""
    most = question.fleet.max_airborne
    held = _notable(waits, waits.room)
    if held and most is not None:
        text = f"{_wait(len(held))}, as no more than {counted(most, 'drone')} may fly at once"
        yield words("preflight.room", text, missions=len(held), drones=most)


def _notable(waits: Waits, seconds: Mapping[str, float]) -> list[str]:
    return [name for name, waited in seconds.items() if waited >= NOTABLE * waits.seconds > 0.0]


def _wait(missions: int) -> str:
    return f"{counted(missions, 'mission')} {'waits' if missions == 1 else 'wait'}"


HIGH = 0.95
"""The share of runs that end before what is called high."""


def without_runs(revision: int, problems: list[Words]) -> Forecast:
    """Return the forecast of a Start that would be refused."""
    return {
        "revision": revision,
        "runs": 0,
        "world": "alone",
        "median": None,
        "high": None,
        "missions": [],
        "drones": [],
        "lowest_battery": None,
        "bottlenecks": [],
        "assumed": [],
        "problems": problems,
        "rehearsal": None,
    }


def forecast(
    question: Question,
    keys: Sequence[str],
    flown: Flown,
    rehearsal: str | None,
    problems: list[Words],
) -> Forecast:
    """Return what runs say; there is at least one. `keys` are those of the missions."""
    runs = flown.runs
    rehearsed = flown.rehearsed
    times = sorted(run.seconds for run in telling(runs))
    ends = question.until is None
    levels = [run.battery for run in runs if run.battery is not None]
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
        "drones": readiness(question, flown.needs),
        "lowest_battery": min(levels, default=None),
        "bottlenecks": [] if rehearsed is None else bottlenecks(question, rehearsed.waits),
        "assumed": _assumed(question, rehearsed),
        "problems": [*problems, *_given_up(runs)],
        "rehearsal": rehearsal,
    }


def readiness(question: Question, needs: Needs) -> list[Readiness]:
    """Return how the drones stand before the Start."""
    found: list[Readiness] = []
    for one in question.present:
        wanted = needs.levels.get(one.id, question.kind(one.id).reserve)
        seconds = question.ready_in(one, wanted)
        is_for_later = one.id in needs.why and one.id not in needs.levels
        is_docked = docked(one.at, question.entries[one.id].home)
        why = one.out or _why_not(one, wanted, seconds, needs, docked=is_docked)
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
    if wanted > 1.0:
        text = "no battery lasts for any of these missions and the way home"
        return words("preflight.too-far", text)
    has = f"its battery has {percent(one.battery)}, any of these missions takes {percent(wanted)}"
    facts = {"battery": one.battery, "needs": wanted}
    if seconds is not None:
        text = f"{has}: in {duration(seconds)}"
        return words("preflight.charges", text, ready_in=seconds, **facts)
    if docked:
        return words("preflight.uncharged", f"{has}, and nothing charges it", **facts)
    return words("preflight.low-away", f"{has}: it flies home first to charge", **facts)


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
