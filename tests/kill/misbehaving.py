"""Flies apps whose hooks misbehave as real processes under `--supervise`, and says what came of it.

    python -m tests.kill.misbehaving --times 3

Each trial has missions whose hooks do something that hooks must not do, and one that is innocent.
The innocent one must be COMPLETED, the others must end as they are meant to and say why, the exit
code must be that of how they ended, and no process may be left running.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from tempfile import mkdtemp
from time import monotonic

from pluto_fleet.journal.reader import Reader
from tests.kill.judge import folded
from tests.kill.lives import Flight, alive, eventually
from tests.kill.misfits import RAISED, VALUES, misfits_in, plan_of
from tests.kill.trial import end_gateway, gateway_of

LONGEST_OUTPUT = 400_000
"""Bytes that a flight may print, no matter what its hooks say."""

Trips = Sequence[tuple[str, str]]
Look = Callable[[Flight], Iterator[str]]


def _nothing_more(_: Flight) -> Iterator[str]:
    yield from ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """Missions that misbehave, and what must come of them."""

    name: str
    missions: Sequence[tuple[str, Trips]]
    fails: frozenset[str] = frozenset()
    """The missions that must fail, with a reason; all others must be completed."""
    world: str = ""
    """What its fleet file says besides."""
    refused: bool = False
    """It must not be flown at all."""
    lives: int = 1
    look: Look = _nothing_more
    """Yields what else is wrong."""

    def fly(self, source: Path, folder: Path) -> list[str]:
        """Fly it, and return what is wrong."""
        folder.mkdir(parents=True)
        files = plan_of(*self.missions).write(folder)
        with files["fleet"].open("a") as fleet:
            fleet.write(self.world)
        flight = Flight(app="misfits", source=source, folder=folder, speed=20.0)
        try:
            flight.start("--supervise")
            code = flight.see_through()
            return [*self._wrong(flight, code), *self.look(flight)]
        finally:
            flight.end()
            end_gateway(flight.journal)

    def _wrong(self, flight: Flight, code: int) -> Iterator[str]:
        said = flight.lives[-1]
        if self.refused:
            if code != 2 or flight.journal.exists() or "internal error" in said:
                yield f"it was not refused, and ended with {code}: {said}"
            return
        with closing(Reader(flight.journal)) as reader:
            missions = folded([row.text for row in reader.rows()]).missions
        for name, record in missions.items():
            meant = "FAILED" if name in self.fails else "COMPLETED"
            if record["status"] != meant:
                yield f"{name} is {record['status']} and not {meant}: {record['reason']}"
            if meant == "FAILED" and not record["reason"]:
                yield f"{name} does not say why it failed"
        if len(missions) != len(self.missions) + 1:
            yield f"there are {len(missions)} missions"
        if code != (1 if self.fails else 0):
            yield f"the exit code is {code}"
        if said.count("it is started again") != self.lives - 1:
            yield f"it was started again {said.count('it is started again')} times"
        if "Traceback" in said and "raised" not in said:
            yield "a traceback is shown"
        if len(said) > LONGEST_OUTPUT:
            yield f"it has printed {len(said)} characters"
        if "internal error" in said:
            yield "there was an internal error"
        if not eventually(lambda: gateway_of(flight.journal) is None):
            yield "its gateway is left running"


def _children(flight: Flight) -> Iterator[str]:
    """Yield what is wrong with what became of a hook's own children."""
    for name, meant in (("killed", "[True, True, True]"), ("came_back", "1")):
        file = flight.folder / name
        code = file.read_text() if file.exists() else "nothing"
        if code != meant:
            yield f"{name}: {code} and not {meant}"
    lasting = int((flight.folder / "lasting").read_text())
    if not eventually(lambda: not alive(lasting)):
        yield "a child is left running"


def _alone(action: str, names: Sequence[str]) -> tuple[tuple[str, Trips], ...]:
    """Return a mission each for these trips."""
    return tuple((f"{action} {name}", ((name, action),)) for name in names)


_JUDGED = tuple((f"judge {name}", (("fine", "act"),)) for name in (*RAISED, "huge", "long"))
_PREPARED = tuple((f"prepare {name}", (("fine", "act"),)) for name in RAISED)

_SOURCE = """
[[world.source]]
quantity = "temperature"
at = [0.5, 1.5]
peak = {peak}
radius = {radius}
"""

_EDGE = "".join(
    _SOURCE.format(peak=peak, radius=radius)
    for peak in ("1e9", "-1e9", "5e-324")
    for radius in ("0.01", "100000.0")
)

TRIALS = (
    Trial(
        name="children that are ended",
        missions=(
            ("children", (("children", "act"), ("after", "act"))),
            ("forks", (("forks", "act"), ("after", "act"))),
        ),
        look=_children,
    ),
    Trial(
        name="values that are returned",
        missions=(*_alone("act", VALUES), *_alone("dig", VALUES)),
    ),
    Trial(
        name="errors that are raised",
        missions=(*_alone("act", RAISED), *_alone("dig", RAISED), *_JUDGED, *_PREPARED),
        fails=frozenset(
            [
                *(
                    f"{hook} {name}"
                    for hook in ("act", "dig", "judge", "prepare")
                    for name in RAISED
                ),
                "judge huge",
                "judge long",
            ]
        ),
    ),
    *(
        Trial(name=f"{name} that is left behind", missions=_alone(hook, [name]))
        for hook, name in (
            ("dig", "executor"),
            ("dig", "pool"),
            ("act", "thread"),
            ("act", "task"),
            ("dig", "atexit"),
        )
    ),
    Trial(name="tasks that end all", missions=_alone("act", ("ends", "stops"))),
    Trial(
        name="an end that is not true",
        missions=(*_alone("act", ["exit"]), *_alone("dig", ["says all is well"])),
        fails=frozenset(["act exit"]),
        lives=2,
    ),
    Trial(
        name="exits that look like an end",
        missions=tuple(
            (f"leaves {code}", ((f"leaves{code}", "act"), ("after", "act")))
            for code in (0, 1, 2, 4, 78, 129, 130, 143)
        ),
        lives=9,
    ),
    Trial(
        name="plans at the edge of what is taken",
        missions=(("measures", (("here", "measure"), ("there", "measure"))),),
        world=_EDGE,
    ),
    Trial(
        name="plans beyond that",
        missions=(("measures", (("here", "measure"),)),),
        world=_SOURCE.format(peak="1.0", radius="1e-300"),
        refused=True,
    ),
)


def main() -> int:
    """Fly all trials; 1 if anything was wrong."""
    parser = ArgumentParser(prog="python -m tests.kill.misbehaving", description=__doc__)
    parser.add_argument("--times", type=int, default=3, help="flights of each trial (default: 3)")
    parser.add_argument("--folder", type=Path, help="where to fly; default: a new one, named")
    parser.add_argument("--only", help="the trial of this name alone")
    options = parser.parse_args()
    folder = options.folder or Path(mkdtemp(prefix="misbehaving-"))
    print(f"flights in {folder}", flush=True)
    source, problems, began = misfits_in(folder / "app") / "src", 0, monotonic()
    for trial in TRIALS:
        for number in range(options.times if options.only in (None, trial.name) else 0):
            wrong = trial.fly(source, folder / trial.name.replace(" ", "-") / str(number))
            problems += len(wrong)
            print(f"{monotonic() - began:.0f} s: {trial.name}, {number + 1}: {wrong or 'well'}")
            sys.stdout.flush()
    print(f"{problems} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
