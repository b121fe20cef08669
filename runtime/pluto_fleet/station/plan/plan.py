"""The plan that users draw: shared by all pages, validated, and stored with every change."""

from __future__ import annotations

import time
from asyncio import to_thread
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...shared.domain.errors import BadInput, PlutoError
from ...shared.domain.text import counted, printable, quoted
from ...shared.domain.values import shown
from . import kept as on_disk
from .example import example_missions
from .history import PlanHistory, Step
from .problems import FlyabilityCache, PlanProblem, as_in_a_file, as_json, read
from .shape import COMPLETED, Shape, check_together, missions_from, trips_of
from .text import NAME, renamed, shapes_of, text_of
from .unfinished import unfinished_shapes

if TYPE_CHECKING:
    from ...app import App
    from ...files.fleet import FleetFile
    from ...shared.domain.model import Mission

MOST_SHOWN = 1_000
"""The most problems that pages get."""

MOST_SAID = 10
"""The most problems in the answer to Start."""


class Stale(PlutoError):
    """The plan has changed since: the edit was made on an old revision."""


class MissionPlan:
    """The drawn missions; launched ones cannot be changed while anything flies.

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
        self.history = PlanHistory()
        self._missions = list(kept.missions)
        self._unread = read(app, fleet.airspace, self._missions)[1]
        self._flyability = FlyabilityCache(app, fleet)

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
        while not self._flyability.knows(self._readable()):  # the plan may change meanwhile
            await self._flyability.ask(self._readable())

    # Changes by pages

    def replace(self, revision: object, missions: object, by: str = "") -> None:
        """Replace the plan by a page's; raise `Stale` if that was made on an old revision.

        `by`: which browser it was, whose change it is to undo.
        """
        given = missions_from(missions, self._app)
        drawn = self._with_launched(given)
        if drawn != self._missions or self._overrules(given):
            self._check_current(revision)
        if drawn != self._missions:  # an identical plan is no conflict
            self._change(drawn, by)

    def step_back(self, revision: object, by: str, step: Step) -> None:
        """Undo the last change of a browser, or redo what it has undone; changes of others stay.

        Raises `BadInput` if there is none, others have changed the same since, or it flies.
        """
        self._check_current(revision)
        missions = self.history.without_last(by, step, self._missions)
        after = {one["key"]: one for one in missions}
        for one in self._missions:
            if one["launched"] and after.get(one["key"]) != one:
                raise BadInput(
                    f"mission {quoted(str(one['name']))} flies: it cannot be changed now"
                )
        self._change(self._with_launched(missions), by, step)

    def import_toml(
        self, text: str, revision: object, file: str = NAME, folder: Path | None = None
    ) -> None:
        """Replace the missions that were not launched by those of a file; `folder`: where it lies."""
        self._check_current(revision)
        self.take(self._shapes(text, file, folder), revision)

    async def import_file(
        self, text: str, revision: object, file: str = NAME, by: str = ""
    ) -> None:
        """Do the same in a thread, as reading a large file takes seconds."""
        self._check_current(revision)
        given = await to_thread(self._shapes, text, file)
        self.take(given, revision, by)

    def _shapes(self, text: str, file: str, folder: Path | None = None) -> list[Shape]:
        return shapes_of(text, self._app, self._fleet.airspace, self.landmarks, file, folder)

    def take(self, read: Sequence[Shape], revision: object, by: str = "") -> None:
        """Replace the missions that were not launched by these, which have no keys."""
        self._check_current(revision)
        given = self._shaped(read)
        # a plan that was exported during the flight has those missions, too
        flying = [as_in_a_file(one) for one in self._missions if one["launched"]]
        new = [mission for mission in given if as_in_a_file(mission) not in flying]
        self._change(self._with_launched(new), by)

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

    def add(self, read: Sequence[Shape], revision: object, by: str = "") -> None:
        """Add these missions, which have no keys, under names that no other has."""
        self._check_current(revision)
        names = [str(mission["name"]) for mission in self._missions]
        self._change([*self._missions, *self._shaped(renamed(read, names))], by)

    def example(self, revision: object, by: str = "") -> None:
        """Add example missions that this app and fleet can fly."""
        self._check_current(revision)
        names = [str(mission["name"]) for mission in self._missions]
        added = example_missions(self._app, self._fleet, names)
        self._change([*self._missions, *self._shaped(added)], by)

    # Flights

    def launchable(
        self, chosen: Collection[str] | None = None
    ) -> tuple[list[Mission[Any]], list[str]]:
        """Return the missions for Start, with their keys; raise `BadInput` if it cannot start.

        These are the chosen ones, by their keys. Without a choice: all that have not been completed; if
        all were, all again, but not while any of them flies. They are new objects each time, as a
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
        names = [str(one["name"]) for one in self._missions]
        missions, _ = read(self._app, self._fleet.airspace, waiting, names)
        return [self._in_order(one, waiting) for one in missions], keys

    def _in_order(self, mission: Mission[Any], started: Sequence[Shape]) -> Mission[Any]:
        """Return a mission that comes after those that are under way; what was completed before is settled.

        Raises `BadInput` if it comes after one that is not started with it.
        """
        under_way = {str(one["name"]) for one in self._missions if one["launched"]}
        under_way.update(str(one["name"]) for one in started)
        done = {str(one["name"]) for one in self._missions if one["ended"] == COMPLETED}
        after = []
        for name in mission.promises.get("after", ()):
            if name in under_way:
                after.append(name)
            elif name not in done:
                who = f"Mission {quoted(mission.name)} comes after {quoted(name)}"
                raise BadInput(f"{who}, which is not started: start both, or that one first")
        promises = {key: one for key, one in mission.promises.items() if key != "after"}
        return replace(mission, promises=promises | ({"after": after} if after else {}))

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
        """Lock these missions, which fly now."""
        self._mark(lambda mission: bool(mission["launched"]) or mission["key"] in keys)

    def adopt(self, names: Collection[str]) -> None:
        """Lock the missions of these names, which fly according to a journal, and no others."""
        self._mark(lambda mission: mission["name"] in names)

    def settle(self, ends: Mapping[str, str]) -> None:
        """Record the final statuses of a flight's missions, by name."""

        def settled(mission: Shape) -> Shape:
            if not mission["launched"]:
                return mission
            return {**mission, "launched": False, "ended": ends.get(str(mission["name"]))}

        missions = [settled(mission) for mission in self._missions]
        if missions != self._missions:
            self._change(missions)

    def unlock(self) -> None:
        """Unlock all missions: nothing flies any more."""
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
        """Return whether an edit changes a mission that has been launched meanwhile."""
        fixed = {one["key"]: as_in_a_file(one) for one in self._missions if one["launched"]}
        return any(one["key"] in fixed and as_in_a_file(one) != fixed[one["key"]] for one in given)

    def _with_launched(self, drawn: Sequence[Shape]) -> list[Shape]:
        """Restore launched missions in an edit; missing ones come first."""
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
        """Add keys to missions and trips that do not come from a page."""
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

    def _change(self, missions: list[Shape], by: str = "", step: Step = Step.EDIT) -> None:
        known = {one["key"]: one for one in self._missions}
        missions = [  # what has not changed is kept once, however many revisions are
            known[one["key"]] if known.get(one["key"]) == one else one for one in missions
        ]
        self._unread = read(self._app, self._fleet.airspace, missions)[1]
        self.revision += 1
        self.history.note(self.revision, self._missions, missions, by, step)
        self._missions = missions
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
    return {**drawn, "ended": before["ended"] if same else None}
