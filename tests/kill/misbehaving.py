"""Flies apps whose hooks misbehave as real processes under `--supervise`, and says what came of it.

    python -m tests.kill.misbehaving --times 3

Each trial has missions whose hooks do something that hooks must not do, and one that is innocent.
The innocent one must be COMPLETED, the others must end as they are meant to and say why, the exit
code must be that of how they ended, and no process may be left running.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from tempfile import mkdtemp

from pluto_fleet.journal.reader import Reader
from tests.kill.judge import folded
from tests.kill.lives import Flight, alive, eventually
from tests.kill.misfits import RAISED, misfits_in, plan_of
from tests.kill.trial import end_gateway, gateway_of
from tests.kit.campaign import Campaign

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
    lives: int = 1
    look: Look = _nothing_more
    """Yields what else is wrong."""

    def fly(self, source: Path, folder: Path) -> list[str]:
        """Fly it, and return what is wrong."""
        folder.mkdir(parents=True)
        plan_of(*self.missions).write(folder)
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
        name="errors that are raised",
        missions=(*_alone("act", RAISED), *_alone("dig", RAISED)),
        fails=frozenset(f"{hook} {name}" for hook in ("act", "dig") for name in RAISED),
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
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly all trials; 1 if anything was wrong."""
    campaign = Campaign("tests.kill.misbehaving", __doc__)
    campaign.unit = "flight"
    campaign.option("--times", type=int, default=3, help="flights of each trial (default: 3)")
    campaign.option("--folder", type=Path, help="where to fly; default: a new one, named")
    campaign.option("--only", metavar="NAME", help="the trial of this name alone")
    options = campaign.parse(arguments)
    folder = options.folder or Path(mkdtemp(prefix="misbehaving-"))
    print(f"flights in {folder}", flush=True)
    source = misfits_in(folder / "app")
    by_name = {trial.name: trial for trial in TRIALS}
    names = by_name if options.only is None else [options.only]
    flights = [(name, number) for name in names for number in range(options.times)]

    def fly(flight: tuple[str, int]) -> list[str]:
        name, number = flight
        return by_name[name].fly(source, folder / name.replace(" ", "-") / str(number))

    for (name, number), wrong in campaign.each(fly, flights):
        if wrong:
            campaign.found(f"{name}, {number}", *wrong)
    return campaign.over()


if __name__ == "__main__":
    sys.exit(main())
