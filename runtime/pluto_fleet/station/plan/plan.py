"""The plan that users draw, shared by all pages, validated and stored with every change; and changes of what flies."""

from __future__ import annotations

import time
from asyncio import to_thread
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...flight.changing import left, refuse_if_stale
from ...shared.domain.errors import BadInput, PlutoError
from ...shared.domain.text import counted, printable, quoted
from . import kept as on_disk
from .example import example_missions
from .in_flight import differs, drawn_change, followed, named, only_missing
from .problems import FlyabilityCache, PlanProblem, as_in_a_file, as_json, bare, read
from .shape import COMPLETED, Shape, check_together, missions_from, trips_from
from .text import NAME, renamed, shapes_of, text_of, unfinished_shapes

if TYPE_CHECKING:
    from ...app import App
    from ...files.fleet import FleetFile
    from ...flight.live_flight import LiveFlight
    from ...flight.recorded_flight import RecordedFlight
    from ...journal.standing import Record
    from ...shared.domain.model import Mission


_NOTHING: Mapping[str, Sequence[Shape]] = {}

MOST_SHOWN = 1_000

MOST_SAID = 10


class Stale(PlutoError):
    """The plan has changed since: the edit was made on an old revision."""


class MissionPlan:
    """The drawn missions; of launched ones only what has not flown can be changed while they fly.

    Every change creates a new revision, and names the one that it was made on.
    """

    def __init__(
        self, app: App, fleet: FleetFile, keep: Path | None, now: Callable[[], float] = time.time
    ) -> None:
        self._app, self._fleet, self._keep = app, fleet, keep
        self.landmarks = fleet.landmarks
        """What a missions file may name: places and zones of the map."""
        kept = on_disk.read(keep, app) if keep else on_disk.KeptPlan()
        self.trouble = kept.said
        """Why the plan could not be stored, for pages; empty: it was."""
        # From the clock: a revision must be unique, even if a plan could not be stored.
        self.revision = max(kept.revision + 1, round(now() * 1000))
        self._missions = list(kept.missions)
        self._unread = read(app, fleet.airspace, self._missions)[1]
        self._flyability = FlyabilityCache(app, fleet)
        self.on_change: Callable[[], object] = lambda: None

    def data(self) -> Shape:
        """Return the plan for pages."""
        return {
            "revision": self.revision,
            "missions": self._missions,
            "problems": [as_json(one) for one in islice(self._problems(), MOST_SHOWN)],
            "said": self.trouble,
        }

    @property
    def is_empty(self) -> bool:
        """Whether it has no missions."""
        return not self._missions

    async def examined(self) -> None:
        """Wait until all missions have been checked against the fleet.

        The check runs in a thread. Before, `data` has only the other problems.
        """
        while self._flyability.unknown(self._readable()):  # the plan may change meanwhile
            await self._flyability.ask(self._readable())

    # Changes by pages

    def replace(self, revision: object, missions: object) -> None:
        """Replace the plan by a page's; raise `Stale` if that was made on an old revision."""
        given = missions_from(missions, self._app)
        drawn = self._with_launched(given)
        if drawn != self._missions or self._overrules(given):
            self.check_current(revision)
        self.take(drawn)  # an identical plan is no conflict

    # Changes of what flies

    def drawn_in_flight(self, missions: object) -> dict[str, Sequence[Shape]]:
        """Return the trips of a page's missions that fly and were drawn otherwise, by their names."""
        given = {one["key"]: one for one in missions_from(missions, self._app)}
        return {
            name: given[fixed["key"]]["trips"]
            for name, fixed in self._flying.items()
            if fixed["key"] in given and differs(fixed, given[fixed["key"]])
        }

    def launched_mission(self, name: str) -> Shape | None:
        """Return a mission that flies; None: the plan does not have it."""
        return self._flying.get(name)

    def merged(self, missions: object, trips: Mapping[str, Sequence[Shape]]) -> list[Shape]:
        """Return the plan of a page with these trips of missions that fly, by name; None: the plan itself."""
        given = self._missions if missions is None else missions_from(missions, self._app)
        return self._with_launched(given, trips)

    def take(self, missions: list[Shape]) -> None:
        """Take other missions as the plan, if they are others."""
        if missions != self._missions:
            self._change(missions)

    def follow(self, name: str, record: Record) -> None:
        """Let a mission have the trips that it flies, if they were changed elsewhere."""
        fixed = self._flying.get(name)
        if fixed is not None:
            trips = followed(self._app, self._fleet.airspace, fixed, record, self._keyed())
            self.take(self.merged(None, {name: trips}))

    def fly_with(self, fleet: FleetFile) -> None:
        """Check missions against another fleet from now on: a drone has joined."""
        self._fleet, self._flyability = fleet, FlyabilityCache(self._app, fleet)

    @property
    def _names(self) -> list[str]:
        return [one["name"] for one in self._missions]

    @property
    def _flying(self) -> dict[str, Shape]:
        return {one["name"]: one for one in self._missions if one["launched"]}

    def import_toml(
        self, text: str, revision: object, file: str = NAME, folder: Path | None = None
    ) -> None:
        """Replace the missions that were not launched by those of a file; `folder`: where it lies."""
        self.take_instead(self._shapes(text, file, folder), revision)

    async def import_file(self, text: str, revision: object, file: str = NAME) -> None:
        """Do the same in a thread, as reading a large file takes seconds."""
        self.check_current(revision)
        given = await to_thread(self._shapes, text, file)
        self.take_instead(given, revision)

    def _shapes(self, text: str, file: str, folder: Path | None = None) -> list[Shape]:
        # a map lies where it did as the station began, whatever is written into its file
        landmarks = replace(self.landmarks, plane=self._fleet.plane)
        return shapes_of(text, self._app, self._fleet.airspace, landmarks, file, folder)

    def take_instead(self, read: Sequence[Shape], revision: object) -> None:
        """Replace the missions that were not launched by these, which have no keys."""
        self.check_current(revision)
        given = self._shaped(read)
        # a plan that was exported during the flight has those missions, too
        flying = [as_in_a_file(one) for one in self._missions if one["launched"]]
        new = [mission for mission in given if as_in_a_file(mission) not in flying]
        self._change(self._with_launched(new))

    def saved(self, text: str, file: str) -> tuple[list[Shape], str]:
        """Return the missions of a plan that was kept, without keys, and what still has to be done to fly it.

        Raises `BadInput` if it is no plan. It changes nothing, and may run in a thread.
        """
        try:
            return self._shapes(text, file), ""
        except BadInput as error:
            shapes = unfinished_shapes(text, self._app, file)
            self._shaped(shapes)
            return shapes, str(error)

    def add(self, read: Sequence[Shape], revision: object) -> None:
        """Add these missions, which have no keys, under names that no other has."""
        self.check_current(revision)
        self._change([*self._missions, *self._shaped(renamed(read, self._names))])

    def example(self, revision: object) -> None:
        """Add example missions that this app and fleet can fly."""
        self.check_current(revision)
        added = example_missions(self._app, self._fleet, self._names)
        self._change([*self._missions, *self._shaped(added)])

    # Flights

    def launchable(
        self, chosen: Collection[str] | None = None, only_failed: bool = False
    ) -> tuple[list[Mission[Any]], list[str]]:
        """Return the missions for Start, with their keys; raise `BadInput` if it cannot start.

        These are the chosen ones, by their keys. Without a choice: all that have not been completed; if
        all were, all again, but not while any of them flies. They are new objects each time, as a
        flight changes them. `only_failed`: those that failed, each with the trips that were not done.
        """
        self._flyability.ask_at_once(self._readable())
        waiting = self._wanted(chosen, only_failed)
        keys = [one["key"] for one in waiting]
        of_these = (None, *keys)
        problems = [one.alone for one in self._problems() if one.mission in of_these]
        if problems:
            more = len(problems) - MOST_SAID
            if more > 0:
                problems[MOST_SAID:] = [f"… and {counted(more, 'more problem')}"]
            raise BadInput("\n".join(problems))
        missions, _ = read(self._app, self._fleet.airspace, waiting, self._names)
        return [self._in_order(one, waiting) for one in missions], keys

    def _in_order(self, mission: Mission[Any], started: Sequence[Shape]) -> Mission[Any]:
        """Return a mission that comes after those that are under way; what was completed before is settled.

        Raises `BadInput` if it comes after one that is not started with it.
        """
        under_way = {*self._flying, *(one["name"] for one in started)}
        done = {one["name"] for one in self._missions if one["ended"] == COMPLETED}
        after = []
        for name in mission.promises.get("after", ()):
            if name in under_way:
                after.append(name)
            elif name not in done:
                who = f"Mission {quoted(mission.name)} comes after {quoted(name)}"
                raise BadInput(f"{who}, which is not started: start both, or that one first")
        promises = {key: one for key, one in mission.promises.items() if key != "after"}
        return replace(mission, promises=promises | ({"after": after} if after else {}))

    def _wanted(self, chosen: Collection[str] | None, only_failed: bool) -> list[Shape]:
        waiting = [mission for mission in self._missions if not mission["launched"]]
        if chosen is None and only_failed:
            return only_missing(self._app, waiting, chosen=False)
        if chosen is None:
            to_do = [mission for mission in waiting if mission["ended"] != COMPLETED]
            return waiting if not to_do and len(waiting) == len(self._missions) else to_do
        known = {mission["key"]: mission for mission in self._missions}
        for key in chosen:
            if key not in known:
                raise BadInput(
                    f"no mission of the plan has the key {quoted(key)}: look at the plan again"
                )
            if known[key]["launched"]:
                raise BadInput(
                    f"mission {quoted(str(known[key]['name']))} belongs to the flight that is under"
                    " way: it can be started again when that has ended"
                )
        wanted = [mission for mission in waiting if mission["key"] in chosen]
        return only_missing(self._app, wanted, chosen=True) if only_failed else wanted

    def launched(self, keys: Collection[str], only_failed: bool = False) -> None:
        """Lock these missions, which fly now; unless `only_failed`, nothing of them counts as done."""

        def locked(mission: Shape) -> Shape:
            if mission["launched"] or mission["key"] not in keys:
                return mission
            flies = {**mission, "launched": True}
            if not only_failed:
                flies.pop("done", None)
            return flies

        self.take([locked(mission) for mission in self._missions])

    def adopt(self, names: Collection[str]) -> None:
        """Lock the missions of these names, which fly according to a journal, and no others."""
        self._mark(lambda mission: mission["name"] in names)

    def settle(
        self, ends: Mapping[str, str], done: Mapping[str, Sequence[str]] | None = None
    ) -> None:
        """Record the final statuses of a flight's missions, and which of their trips were done, by name."""

        def settled(mission: Shape) -> Shape:
            if not mission["launched"]:
                return mission
            name = mission["name"]
            ended = {**mission, "launched": False, "ended": ends.get(name)}
            before: Any = ended.pop("done", ())
            trips = [*dict.fromkeys((*before, *(done or {}).get(name, ())))]
            return ended | ({"done": trips} if trips and ended["ended"] != COMPLETED else {})

        self.take([settled(mission) for mission in self._missions])

    def unlock(self) -> None:
        """Unlock all missions: nothing flies any more."""
        self._mark(lambda _: False)

    def export_toml(self, keys: Collection[str] | None = None, only_failed: bool = False) -> str:
        """Return the missions file of these missions, or of all; `only_failed`: of what is missing of them."""
        chosen = [one for one in self._missions if keys is None or one["key"] in keys]
        if only_failed:
            chosen = only_missing(self._app, chosen, chosen=True)
        return text_of(self._app, chosen)

    def _problems(self) -> Iterator[PlanProblem]:
        yield from self._unread
        yield from self._flyability.known(self._readable())

    def _readable(self) -> list[Shape]:
        bad = {problem.mission for problem in self._unread}
        return [mission for mission in self._missions if mission["key"] not in bad]

    def _mark(self, is_launched: Callable[[Mapping[str, object]], bool]) -> None:
        self.take([{**one, "launched": is_launched(one)} for one in self._missions])

    def check_current(self, revision: object) -> None:
        """Raise `Stale` if a change was made on an old revision."""
        if revision != self.revision:
            raise Stale(f"the plan has been changed meanwhile: it is at {self.revision}")

    def _overrules(self, given: Sequence[Shape]) -> bool:
        """Return whether an edit changes a mission that has been launched meanwhile."""
        fixed = {one["key"]: one for one in self._missions if one["launched"]}
        both = [(fixed[one["key"]], one) for one in given if one["key"] in fixed]
        return any(differs(old, new) or bare(old) != bare(new) for old, new in both)

    def _with_launched(
        self, drawn: Sequence[Shape], trips: Mapping[str, Sequence[Shape]] = _NOTHING
    ) -> list[Shape]:
        """Restore launched missions in an edit, with these trips by name; missing ones come first."""
        fixed = {
            one["key"]: {**one, "trips": [*trips.get(name, one["trips"])]}
            for name, one in self._flying.items()
        }
        known = {one["key"]: one for one in self._missions}
        merged = [
            fixed.pop(mission["key"], _as_it_ended(mission, known.get(mission["key"])))
            for mission in drawn
        ]
        missions = [*fixed.values(), *merged]
        check_together(missions)
        return missions

    def _shaped(self, missions: Sequence[Shape]) -> list[Shape]:
        """Add keys to missions and trips that do not come from a page."""
        keyed = self._keyed()
        shapes = [{**keyed(one), "trips": [*map(keyed, one["trips"])]} for one in missions]
        return missions_from(shapes, self._app)

    def _keyed(self) -> Callable[[Shape], Shape]:
        """Return what gives shapes keys that no other has."""
        taken = {one["key"] for mission in self._missions for one in (mission, *mission["trips"])}
        count = 0

        def keyed(shape: Shape) -> Shape:
            nonlocal count
            key = None
            while key is None or key in taken:
                key, count = f"{self.revision:x}-{count:06x}", count + 1
            return {**shape, "key": key}

        return keyed

    def _change(self, missions: list[Shape]) -> None:
        self._missions = missions
        self._unread = read(self._app, self._fleet.airspace, missions)[1]
        self.revision += 1
        self.on_change()
        if self._keep is None:
            return
        try:
            on_disk.write(self._keep, self._app, self.revision, missions)
        except OSError as error:
            self.trouble = (
                f"The plan could not be written to {printable(str(self._keep))}:"
                f" {error.strerror or error}. What you draw is not lost as long as this runs;"
                " it is written with the next change, if it can be by then."
            )
        else:
            self.trouble = ""


def _as_it_ended(drawn: Shape, before: Shape | None) -> Shape:
    """Keep a mission's final status, unless more than its name has changed."""
    if before is None or not before["ended"]:
        return drawn
    same = as_in_a_file({**drawn, "name": ""}) == as_in_a_file({**before, "name": ""})
    if not same:
        return drawn
    done = {"done": before["done"]} if "done" in before else {}
    return {**drawn, "ended": before["ended"], **done}


Drawn = Mapping[str, Sequence["Shape"]]
"""Trips as a page has drawn them, by the names of their missions."""


class FlightChanges:
    """Makes them, so that the plan and the flight agree at every instant."""

    def __init__(self, app: App, plan: MissionPlan, flight_now: Callable[[], LiveFlight]) -> None:
        """`flight_now` returns the run that can be commanded, or raises `BadInput`."""
        self._app = app
        self._plan = plan
        self._flight_now = flight_now

    async def edit(self, revision: int, missions: object) -> None:
        """Replace the plan by a page's; what has not flown of missions that fly is changed in flight.

        Raises `Stale` if it was drawn on an old revision, and `BadInput` if that cannot be flown so.
        """
        drawn = self._plan.drawn_in_flight(missions)
        if not drawn:
            self._plan.replace(revision, missions)
            return
        self._plan.check_current(revision)
        await self._flight_now().carry_out(lambda life: self._change(life, drawn, missions))

    async def change_trips(self, id: str, given: Mapping[str, Any]) -> str:
        """Change what has not flown of one mission, by a command with this id."""
        name = str(given["mission"])
        replaces = given["replaces"]
        trips = trips_from(given["trips"], self._app)

        def do(life: RecordedFlight) -> str:
            record = life.control.record(name)
            fixed = self._plan.launched_mission(name)
            if replaces is not None:
                refuse_if_stale(name, record, replaces)
            if fixed is None:  # it was started elsewhere, by a plan that was not drawn here
                said = life.control.change_trips(name, list(map(bare, trips)), None)
            else:
                waits = [one["name"] for one in left(record)]
                kept = [one for one in named(fixed, fixed["trips"]) if one["name"] not in waits]
                said = self._change(life, {name: [*kept, *trips]}, None)
            life.control.remember(id, "change-trips")
            return said

        return await self._flight_now().carry_out(do)

    def _change(self, life: RecordedFlight, drawn: Drawn, missions: object) -> str:
        """Let missions that fly have these trips; all of that can be done, or nothing is."""
        changes = {}
        for name, trips in drawn.items():
            record = life.control.record(name)
            fixed = self._plan.launched_mission(name)
            if fixed is not None:
                changes[name] = drawn_change(self._app, fixed, trips, record)
        made = [
            life.control.changed(name, change.tables)
            for name, change in changes.items()
            if change.is_one
        ]
        plan = self._plan.merged(missions, {name: one.trips for name, one in changes.items()})
        for make in made:
            make()
        self._plan.take(plan)
        return f"{', '.join(map(quoted, drawn))}: what has not flown is changed"
