"""The plan that people draw: one for all who look at it, checked, and kept with every change."""

from __future__ import annotations

import time
from asyncio import to_thread
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import BadInput, PlutoError
from plutoc_runtime.domain.text import counted, printable, quoted

from ...files.errors import shown
from . import kept as on_disk
from .example import example_missions
from .problems import FlyabilityCache, PlanProblem, as_in_a_file, as_json, read
from .shape import COMPLETED, Shape, check_together, missions_from, trips_of
from .text import NAME, shapes_of, text_of

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission

    from ...files.fleet import FleetFile

MOST_SHOWN = 1_000
"""Problems that pages get at most."""

MOST_SAID = 10
"""Problems that the answer to Start names; pages show all where they are."""


class Stale(PlutoError):
    """The plan has changed since: what was drawn was drawn on an old one."""


class MissionPlan:
    """Missions as they are drawn; those that were launched stay as they are while anything flies.

    Every change has a number, the plan's revision, and says on which one it was drawn.
    """

    def __init__(
        self, app: App, fleet: FleetFile, keep: Path | None, now: Callable[[], float] = time.time
    ) -> None:
        self._app, self._fleet, self._keep = app, fleet, keep
        kept = on_disk.read(keep, app) if keep else on_disk.KeptPlan()
        self.trouble = kept.said
        """What went wrong with keeping it, as pages show it; empty: nothing."""
        # From the clock: no number may ever mean two plans, though one could not be kept.
        self.revision = max(kept.revision + 1, round(now() * 1000))
        self._missions = list(kept.missions)
        self._unread = read(app, fleet.airspace, self._missions)[1]
        self._flyability = FlyabilityCache(app, fleet)

    def data(self) -> Shape:
        """Return the plan as pages get it."""
        return {
            "revision": self.revision,
            "missions": self._missions,
            "problems": [as_json(one) for one in islice(self._problems(), MOST_SHOWN)],
            "said": self.trouble,
        }

    @property
    def is_empty(self) -> bool:
        """Whether nothing was drawn yet."""
        return not self._missions

    async def examined(self) -> None:
        """Wait until it is known of every mission whether the fleet can fly it.

        It is found out beside the loop. Before that `data` tells only what else is wrong.
        """
        while not self._flyability.knows(self._readable()):  # it may change meanwhile
            await self._flyability.ask(self._readable())

    # What pages do

    def replace(self, revision: object, missions: object) -> None:
        """Take the plan that a page has drawn; raise `Stale` if it was drawn on an old one."""
        given = missions_from(missions, self._app)
        drawn = self._with_launched(given)
        if drawn != self._missions or self._overrules(given):
            self._check_current(revision)
        if drawn != self._missions:  # to say once more what is there already is no conflict
            self._change(drawn)

    def import_toml(self, text: str, revision: object, file: str = NAME) -> None:
        """Take the missions of a file, instead of those that were not launched."""
        self._check_current(revision)
        self._take(shapes_of(text, self._app, self._fleet.airspace, file), revision)

    async def import_file(self, text: str, revision: object, file: str = NAME) -> None:
        """Do the same while others go on: reading a large file takes seconds."""
        self._check_current(revision)
        given = await to_thread(shapes_of, text, self._app, self._fleet.airspace, file)
        self._take(given, revision)

    def _take(self, read: Sequence[Shape], revision: object) -> None:
        self._check_current(revision)
        given = self._shaped(read)
        # a plan that was handed out while it flew holds those missions, too
        flying = [as_in_a_file(one) for one in self._missions if one["launched"]]
        new = [mission for mission in given if as_in_a_file(mission) not in flying]
        self._change(self._with_launched(new))

    def example(self, revision: object) -> None:
        """Add missions that this app and this fleet can fly."""
        self._check_current(revision)
        names = [str(mission["name"]) for mission in self._missions]
        added = example_missions(self._app, self._fleet, names)
        self._change([*self._missions, *self._shaped(added)])

    # What flies

    def launchable(
        self, chosen: Collection[str] | None = None
    ) -> tuple[list[Mission[Any]], list[str]]:
        """Return the missions that Start starts, with their keys; raise `BadInput` if it cannot.

        These are the chosen ones, by their keys. Without a choice: all that have not been completed; if
        all were, all anew, but not while any of them flies. They are new ones each time: a
        flight changes them.
        """
        self._flyability.ask_at_once(self._readable())
        waiting = self._wanted(chosen)
        keys = [str(one["key"]) for one in waiting]
        of_these = (None, *keys)
        problems = [one.alone for one in self._problems() if one.mission in of_these]
        if problems:
            more = len(problems) - MOST_SAID
            if more > 0:
                problems[MOST_SAID:] = [f"… and {counted(more, 'more problem')}"]
            raise BadInput("\n".join(problems))
        missions, _ = read(self._app, self._fleet.airspace, waiting)
        return missions, keys

    def _wanted(self, chosen: Collection[str] | None) -> list[Shape]:
        waiting = [mission for mission in self._missions if not mission["launched"]]
        if chosen is None:
            to_do = [mission for mission in waiting if mission["ended"] != COMPLETED]
            return waiting if not to_do and len(waiting) == len(self._missions) else to_do
        known = {str(mission["key"]): mission for mission in self._missions}
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
        return [mission for mission in waiting if mission["key"] in chosen]

    def launched(self, keys: Collection[str]) -> None:
        """These missions fly: they may not be changed now."""
        self._mark(lambda mission: bool(mission["launched"]) or mission["key"] in keys)

    def adopt(self, names: Collection[str]) -> None:
        """Missions of these names fly, and no others: so says a journal that was found."""
        self._mark(lambda mission: mission["name"] in names)

    def settle(self, ends: Mapping[str, str]) -> None:
        """A flight is over: keep how each of its missions has ended, by their names."""

        def settled(mission: Shape) -> Shape:
            if not mission["launched"]:
                return mission
            return {**mission, "launched": False, "ended": ends.get(str(mission["name"]))}

        missions = [settled(mission) for mission in self._missions]
        if missions != self._missions:
            self._change(missions)

    def unlock(self) -> None:
        """Nothing flies any more: every mission may be changed, and launched again."""
        self._mark(lambda _: False)

    def export_toml(self, keys: Collection[str] | None = None) -> str:
        """Return the missions file of these missions, or of all."""
        chosen = [one for one in self._missions if keys is None or one["key"] in keys]
        return text_of(self._app, chosen)

    def _problems(self) -> Iterator[PlanProblem]:
        yield from self._unread
        yield from self._flyability.known(self._readable())

    def _readable(self) -> list[Shape]:
        bad = {problem.mission for problem in self._unread}
        return [mission for mission in self._missions if mission["key"] not in bad]

    def _mark(self, is_launched: Callable[[Mapping[str, object]], bool]) -> None:
        marked = [{**mission, "launched": is_launched(mission)} for mission in self._missions]
        if marked != self._missions:
            self._change(marked)

    def _check_current(self, revision: object) -> None:
        if isinstance(revision, bool) or not isinstance(revision, int):
            raise BadInput(f"the plan's revision {shown(revision)} is not a whole number")
        if revision != self.revision:
            raise Stale(
                f"the plan has been changed meanwhile: it is at {self.revision}, not at {revision}"
            )

    def _overrules(self, given: Sequence[Shape]) -> bool:
        """Say whether a mission is drawn otherwise that has been launched meanwhile."""
        fixed = {one["key"]: as_in_a_file(one) for one in self._missions if one["launched"]}
        return any(one["key"] in fixed and as_in_a_file(one) != fixed[one["key"]] for one in given)

    def _with_launched(self, drawn: Sequence[Shape]) -> list[Shape]:
        """Put those that were launched back as they are; those that are missing come first."""
        fixed = {one["key"]: one for one in self._missions if one["launched"]}
        known = {one["key"]: one for one in self._missions}
        merged = [
            fixed.pop(mission["key"], _as_it_ended(mission, known.get(mission["key"])))
            for mission in drawn
        ]
        missions = [*fixed.values(), *merged]
        check_together(missions)
        return missions

    def _shaped(self, missions: Sequence[Shape]) -> list[Shape]:
        """Give keys to missions and trips that come from elsewhere than a page."""
        taken = {one["key"] for mission in self._missions for one in (mission, *trips_of(mission))}
        count = 0

        def keyed(shape: Shape) -> Shape:
            nonlocal count
            key = None
            while key is None or key in taken:
                key, count = f"{self.revision:x}-{count:06x}", count + 1
            return {**shape, "key": key}

        shapes = [{**keyed(one), "trips": [*map(keyed, trips_of(one))]} for one in missions]
        return missions_from(shapes, self._app)

    def _change(self, missions: list[Shape]) -> None:
        self._missions = missions
        self._unread = read(self._app, self._fleet.airspace, missions)[1]
        self.revision += 1
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
    """Keep how a mission has ended, unless it is another one now; its name does not make it one."""
    if before is None or not before["ended"]:
        return drawn
    same = as_in_a_file({**drawn, "name": ""}) == as_in_a_file({**before, "name": ""})
    return {**drawn, "ended": before["ended"] if same else None}
