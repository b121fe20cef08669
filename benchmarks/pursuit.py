"""How soon is there a picture of who is seen, with so many drones and so many people?

`python benchmarks/pursuit.py` flies `examples/pursue` in virtual time: its hall, its patrols and its hooks, with 2 to 8 drones and 1 to 10
people, who walk along paths of their own: drawn from a seed, the same in every run of this script. For each pair it prints which share of
them patrols have seen, how long it took from then to their picture, and the share of those within the bound of 5 s; then how often drones
took over from another, how often within reach, and how many who were stayed with were let go as a bound was broken. Ends with 1 if a mission did not end, or
somebody was let go for another reason, or kept although a bound was broken.

`--write FOLDER` also writes `pursuit.json` there, and draws `pursuit.svg`, with matplotlib.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path
from typing import Any

sys.path[:0] = [str(Path(__file__).parents[1])]

import tests  # noqa: F401  # first: all that follows shares one brain
from measuring.lines import Panel, drawn
from measuring.options import at_least_one
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.process.workers import cores, in_workers
from pluto_fleet.report.reactions import Reactions, reactions_of
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.trials.case import fresh
from tests.kit import apps
from tests.kit.pursuit import peopled, releases

DRONES = (2, 3, 4, 5, 6, 7, 8)
PEOPLE = (1, 2, 3, 5, 7, 10)
SEEDS = 20
A_SHIFT = 3600.0
"""Seconds after which a mission should have ended."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One flight."""

    drones: int
    people: int
    seed: int


@dataclass(slots=True, kw_only=True)
class Found:
    """What came of some flights with as many drones and people."""

    people: int = 0
    reactions: Reactions = field(default_factory=Reactions)
    released: int = 0
    wrong: list[str] = field(default_factory=list)
    """What was not as the rule says."""

    def add(self, other: Found) -> None:
        """Add another flight."""
        self.people += other.people
        self.reactions.add(other.reactions)
        self.released += other.released
        self.wrong += other.wrong

    def data(self) -> dict[str, Any]:
        """Return the figures."""
        told = self.reactions.data()
        seen = told["events"].get("intruder", {"raised": 0, "kept": 0, "seconds": None})
        hand_overs = told.get("hand_overs", {"count": 0, "gaps": 0})
        return {
            "seen": seen["raised"] / self.people,
            "seconds": seen["seconds"],
            "in_time": seen["kept"] / seen["raised"] if seen["raised"] else None,
            "hand_overs": hand_overs["count"],
            "gaps": hand_overs["gaps"],
            "released": self.released,
        }


def flown(case: Case) -> Found:
    """Fly one case to its end."""
    example = apps.example("pursue")
    missions = [fresh(mission) for mission in example.missions]
    outcome = simulate(
        example.app,
        missions,
        peopled(example.fleet, case.drones, case.people, case.seed),
        seed=case.seed,
        faults=Faults(),
        until=A_SHIFT,
        on_event=None,
    )
    released, wrong = releases(outcome.events)
    open = [name for name, stands in outcome.standing["missions"].items() if not stands["ended"]]
    wrong += [f"{name} has not ended" for name in open]
    return Found(
        people=case.people,
        reactions=reactions_of(outcome.events),
        released=released,
        wrong=[f"{case}: {one}" for one in wrong],
    )


def all_found(cases: Sequence[Case], jobs: int) -> Mapping[tuple[int, int], Found]:
    """Fly all cases in as many processes; return what came of them by drones and people."""
    apps.example("pursue")  # once for all
    found: dict[tuple[int, int], Found] = {}
    for case, one in zip(cases, in_workers(flown, cases, jobs), strict=True):
        found.setdefault((case.drones, case.people), Found()).add(one)
    return found


def lines(cells: Mapping[tuple[int, int], Mapping[str, Any]]) -> Iterator[str]:
    """Yield the table."""
    yield (
        f"{'drones':>6}{'people':>8}{'seen':>7}{'median':>9}{'p95':>9}{'in time':>9}"
        f"{'hand-overs':>12}{'in reach':>10}{'let go':>8}"
    )
    for (drones, people), cell in cells.items():
        seconds = cell["seconds"]
        times = ("", "") if seconds is None else (seconds["median"], seconds["p95"])
        median, p95 = (f"{time:.1f} s" if time else "" for time in times)
        in_time = "" if cell["in_time"] is None else f"{cell['in_time']:.0%}"
        yield (
            f"{drones:>6}{people:>8}{cell['seen']:>7.0%}{median:>9}{p95:>9}{in_time:>9}"
            f"{cell['hand_overs']:>12}{cell['hand_overs'] - cell['gaps']:>10}{cell['released']:>8}"
        )


def picture(cells: Mapping[tuple[int, int], Mapping[str, Any]]) -> bytes:
    """Draw the latency and the share in time, a line for each number of drones."""
    by_drones = sorted({drones for drones, _ in cells})

    def series(read: Any) -> dict[str, list[tuple[float, float]]]:
        return {
            f"{drones} drones": [
                (people, read(cell))
                for (n, people), cell in cells.items()
                if n == drones and cell["seconds"] is not None
            ]
            for drones in by_drones
        }

    return drawn(
        "From the first sight to the picture",
        "people",
        (
            Panel("median, s", series(lambda cell: cell["seconds"]["median"])),
            Panel("p95, s", series(lambda cell: cell["seconds"]["p95"])),
            Panel("within 5 s, %", series(lambda cell: 100 * cell["in_time"])),
        ),
    )


def main() -> int:
    """Print the table, or JSON."""
    parser = argparse.ArgumentParser(description="How soon there is a picture of who is seen.")
    parser.add_argument("--drones", type=at_least_one, nargs="+", default=DRONES, metavar="N")
    parser.add_argument("--people", type=at_least_one, nargs="+", default=PEOPLE, metavar="N")
    parser.add_argument("--seeds", type=at_least_one, default=SEEDS, help="flights of each pair")
    parser.add_argument("--jobs", type=at_least_one, default=cores(), help="processes at once")
    parser.add_argument("--json", action="store_true", help="print one object instead of a table")
    parser.add_argument("--write", type=Path, metavar="FOLDER", help="where to write and to draw")
    given = parser.parse_args()
    cases = [
        Case(drones=drones, people=people, seed=seed)
        for drones, people, seed in product(given.drones, given.people, range(given.seeds))
    ]
    found = all_found(cases, given.jobs)
    cells = {pair: one.data() for pair, one in found.items()}
    told = [{"drones": pair[0], "people": pair[1], **cell} for pair, cell in cells.items()]
    text = json.dumps({"seeds": given.seeds, "cells": told}, indent=1)
    print(text if given.json else "\n".join(lines(cells)))
    if given.write is not None:
        (given.write / "pursuit.json").write_text(text + "\n")
        (given.write / "pursuit.svg").write_bytes(picture(cells))
    wrong = [one for each in found.values() for one in each.wrong]
    for one in wrong:
        print(one, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
