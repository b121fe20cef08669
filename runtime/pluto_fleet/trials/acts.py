"""What the world saw: every action that was really done, and by which job. No brain writes here."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plutoc_runtime.domain.trace import Event


@dataclass(frozen=True, slots=True, kw_only=True)
class Act:
    """One action, done."""

    job: str
    """`mission/trip/round/attempt`."""
    action: str
    time: float


class Once:
    """Nothing that may be done only once is done twice, and the journal says what was done.

    It is told the journal's events, and at the end what the world saw.
    """

    def __init__(self, repeat: Mapping[str, str]) -> None:
        self._repeat = repeat
        """By action: `safe`, `once` or `ask`."""
        self._launched: dict[str, Place] = {}
        """By job, which trip it flies."""
        self._recorded: dict[str, None] = {}
        self._wanted: Counter[Place] = Counter()
        """How often an evaluator wanted a trip again."""
        self._round: dict[object, object] = {}
        self._completed: dict[object, None] = {}
        """The missions that were."""

    @property
    def done(self) -> int:
        """How many actions were done, as far as that is on record."""
        return len(self._recorded)

    def knows(self, job: str) -> bool:
        """Whether it is on record that a drone was sent to do this."""
        return job in self._launched

    def take(self, event: Event) -> None:
        """Something is on record."""
        match event["event"]:
            case "trip.launched":
                place = (event["mission"], event["trip"], event["round"])
                self._launched["/".join(map(str, (*place, event["attempt"])))] = place
            case "trip.completed":
                place = (event["mission"], event["trip"], event["round"])
                self._recorded["/".join(map(str, (*place, event["attempt"])))] = None
            case "mission.repeated":
                self._round[event["mission"]] = event["round"]
            case "mission.extended":
                mission, redo = event["mission"], event["redo"]
                assert isinstance(redo, list)
                for trip in redo:
                    self._wanted[mission, trip, self._round.get(mission, 0)] += 1
            case "mission.ended" if event["status"] == "COMPLETED":
                self._completed[event["mission"]] = None

    def violations(self, acts: list[Act]) -> list[str]:
        """Return what was done too often, and what is not on record as it was."""
        found = []
        jobs: Counter[str] = Counter()
        places: Counter[Place] = Counter()
        safe = {act.job for act in acts if self._repeat.get(act.action, "once") == "safe"}
        for act in acts:
            place = self._launched.get(act.job)
            if place is None:
                found.append(f"{act.time:g} s: {act.job} was flown before that was on record")
            elif act.job not in safe:
                jobs[act.job] += 1
                places[place] += 1
        for job, times in jobs.items():
            if times > 1:
                found.append(f"the action of {job} was done {times} times")
            if job not in self._recorded and self._launched[job][0] in self._completed:
                found.append(f"the action of {job} was done, and the journal does not say so")
        for place, times in places.items():
            if times > 1 + self._wanted[place]:
                mission, trip, round_ = place
                found.append(f"{trip} of {mission} was done {times} times in round {round_}")
        done = {act.job for act in acts}
        for job in self._recorded:
            if job not in done:
                found.append(f"the journal says that the action of {job} was done: it was not")
        return found


Place = tuple[object, object, object]
"""Mission, trip, round."""
