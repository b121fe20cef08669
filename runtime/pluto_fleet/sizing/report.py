"""The answer in words, and as data."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ..files.fleet import DroneEntry
from ..report.terminal import table
from ..shared.domain.text import counted, number, printable
from .answer import Answer, percent_of, when
from .fleets import Counts
from .question import Question
from .tries import Tally


def report(answer: Answer) -> Iterator[str]:
    if answer.tallies:
        yield from _tried(answer)
        yield ""
    found = answer.found
    if found is None:
        yield f"no fleet is sure to complete {_all_of(answer.question)}{_sure(answer)}:"
        for cause in answer.causes:
            yield f"  {printable(cause.text)}"
        return
    low = percent_of(found.bounds[0])
    do = "completes" if found.drones == 1 else "complete"
    what = f"{_all_of(answer.question)}{_sure(answer)} or more"
    yield f"{_named(answer, found.counts)} {do} {what}"
    yield (
        f"{found.succeeded} of {counted(len(found.runs), 'simulated run')} succeeded:"
        f" {low} or more, with 95 % certainty"
    )
    if answer.causes:
        yield f"one fewer: {printable(answer.causes[0].text)}"
    if answer.question.swapped is not None:
        yield from _spare(answer, found)
    elif answer.with_swaps is not None:
        yield (
            f"with batteries swapped in 1 min instead of charged, {_named(answer, answer.with_swaps)}"
            " would do (--swap 1min)"
        )
    yield ""
    yield from _which(answer, found)


def _tried(answer: Answer) -> Iterator[str]:
    rows = [
        (
            _named(answer, tally.counts),
            str(len(tally.runs)),
            str(tally.succeeded),
            *map(percent_of, tally.bounds),
        )
        for tally in answer.tallies
    ]
    header = ("drones", "runs", "succeeded", "at least", "at most")
    yield from table(header, rows, right=(1, 2, 3, 4))


def _named(answer: Answer, counts: Counts) -> str:
    """Return how many drones there are, by category where there are several."""
    whole = counted(sum(counts), "drone")
    if len(answer.stock.kinds) == 1:
        return whole
    parts = [f"{n} {kind}" for kind, n in zip(answer.stock.kinds, counts, strict=True) if n]
    return f"{whole} ({', '.join(parts)})"


def _all_of(question: Question) -> str:
    missions = len(question.missions)
    what = "the mission" if missions == 1 else f"all {missions} missions"
    return f"{what} {when(question)}".rstrip()


def _sure(answer: Answer) -> str:
    return f" in {number(100 * answer.rule.confidence)} % of runs"


def _spare(answer: Answer, found: Tally) -> Iterator[str]:
    """Yield how many spare batteries that takes."""
    most = batteries(found)
    if most:
        parts = [f"{n} for {kind}" for kind, n in most.items()]
        spare = counted(sum(most.values()), "spare battery").replace("batterys", "batteries")
        yield (
            f"{spare} and as many chargers ({', '.join(parts)}): then one is always full when a drone"
            " comes home"
        )


def batteries(tally: Tally) -> dict[str, int]:
    """Return how many spare batteries are needed, by category: the most in any run."""
    most: dict[str, int] = {}
    for run in tally.runs:
        for kind, number_ in run.batteries:
            most[kind] = max(most.get(kind, 0), number_)
    return most


def _which(answer: Answer, found: Tally) -> Iterator[str]:
    """Yield which drones of the file they are, and what is to be added to it."""
    there, new = drones_of(answer, found)
    if there:
        yield f"of the fleet file: {printable(', '.join(drone.id for drone in there))}"
    if new:
        yield "to be added to it:"
    for drone in new:
        yield ""
        yield "[[drone]]"
        yield f'id = "{drone.id}"'
        yield f'category = "{drone.category}"'
        yield f"home = [{', '.join(map(number, drone.home[:2]))}]"


def drones_of(answer: Answer, tally: Tally) -> tuple[Sequence[DroneEntry], Sequence[DroneEntry]]:
    """Return the drones of a fleet: those of the file, and the others."""
    fleet = answer.stock.of(tally.counts)
    assert fleet is not None
    known = {drone.id for drone in answer.stock.fleet.drones}
    there = [drone for drone in fleet.drones if drone.id in known]
    return there, [drone for drone in fleet.drones if drone.id not in known]


def data(answer: Answer, name: str, seed: int) -> Mapping[str, object]:
    found = answer.found
    whole: dict[str, object] = {
        "app": name,
        "seed": seed,
        "within_s": answer.question.within,
        "confidence": answer.rule.confidence,
        "found": found is not None,
        "drones": None if found is None else _by_kind(answer, found.counts),
        "fleet": [],
        "causes": [{"kind": cause.what, "text": cause.text} for cause in answer.causes],
        "tried": [_tally(answer, tally) for tally in answer.tallies],
    }
    if found is not None:
        there, new = drones_of(answer, found)
        whole["fleet"] = [_drone(drone, drone in new) for drone in (*there, *new)]
    if found is not None and answer.question.swapped is not None:
        whole["spare_batteries"] = batteries(found)
    if answer.with_swaps is not None:
        whole["drones_with_swaps"] = _by_kind(answer, answer.with_swaps)
    return whole


def _by_kind(answer: Answer, counts: Counts) -> dict[str, int]:
    return dict(zip(answer.stock.kinds, counts, strict=True))


def _drone(drone: DroneEntry, new: bool) -> Mapping[str, object]:
    return {"id": drone.id, "category": drone.category, "home": drone.home, "new": new}


def _tally(answer: Answer, tally: Tally) -> Mapping[str, object]:
    low, high = tally.bounds
    good = sorted(run.seconds for run in tally.runs if run.success)
    return {
        "drones": _by_kind(answer, tally.counts),
        "runs": len(tally.runs),
        "succeeded": tally.succeeded,
        "at_least": low,
        "at_most": high,
        "verdict": tally.verdict.value,
        "makespan_s": None if not good else {"least": good[0], "most": good[-1]},
    }
