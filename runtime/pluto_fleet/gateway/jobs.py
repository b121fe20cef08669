"""The ledger's layer: an order to fly is obeyed once by the id of its flight, so that no action is done twice."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any

from ..jobs.reports import DroneReport, Entry, JobState, reported_result
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.hooks.plain_data import point_of
from ..shared.time.kernel import EventKind, Kernel, Key

if TYPE_CHECKING:
    from ..jobs.flown import Flown
    from ..jobs.link import Order
    from ..shared.domain.airspace import Airspace
    from .ledger import Ledger

Report = Callable[[Any], object]
"""Called with the action's result, or the `FlightFailed` that ended the job."""
Fly = Callable[["Order", Callable[[], object], Report], object]
"""Flies an order; it calls the second right before the action is done, which raises if it must not be."""


class Jobs:
    """All jobs that the brain may still ask for."""

    def __init__(
        self,
        kernel: Kernel,
        fly: Fly,
        keys: Mapping[str, Key],
        airspace: Airspace,
        ledger: Ledger | None,
    ) -> None:
        self._kernel, self._fly, self._keys = kernel, fly, keys
        self._airspace = airspace
        self._ledger = ledger
        self._known: dict[str, Entry] = {}
        """By the ids of their flights."""
        if ledger is not None:
            self._known.update((entry.id, entry) for entry in ledger.entries())
        self._listeners: dict[str, Report] = {}
        """What to call with the end of a job."""
        self._remembered: dict[str, DroneReport] = {}
        """The drone that reports a job as done, by the job's id: it may be the only record."""
        self._current: dict[str, Entry] = {}
        """The job of each drone that flies one, or hovers after it for an action of the app's own."""
        self.beside: dict[str, Flown] = {}
        """What was told of those whose action is done beside its target, by their ids."""
        self.boots = dict.fromkeys(keys, 0)
        """The drones' boot numbers in their latest reports."""

    # Requests of the brain

    def fly(self, order: Order, report: Report) -> None:
        """Give a drone its job, unless its action was done before, or may have been."""
        id = order["flight"]
        drone = order["drone"]
        known = self._known.get(id)
        if known is None and id in self._remembered:
            known = self._known[id] = _done(id, self._remembered[id])
        if known is not None and known.state not in _MAY_FLY:
            self._repeated(known, report)
            return
        problem = self._problem(order)
        if problem is not None:
            self._post(drone, partial(report, FlightFailed(Failure.REFUSED, problem)))
            return
        job = Entry(id=id, drone=drone, state=JobState.FLYING, boot=self.boots[drone], flies=True)
        self._known[id] = self._current[drone] = job
        self._listeners[id] = report
        begins = partial(self._begins, job, order["action"])
        self._fly(order, begins, partial(self._ended, job, order["action"] is None))

    def _repeated(self, known: Entry, report: Report) -> None:
        """Answer a repeated job by what is known of it, never by a flight."""
        if known.state is JobState.BEGUN and not known.flies:
            reason = f"it cannot be told whether the action of {known.id} was done"
            self._post(known.drone, partial(report, FlightFailed(Failure.UNKNOWN, reason)))
        else:
            self.attach(known.id, report)

    def _problem(self, order: Order) -> str | None:
        """Return why an order must not be obeyed, as far as the gateway itself knows."""
        drone = order["drone"]
        other = self._current.get(drone)
        if other is not None and other.flies:
            return f"{drone} flies already, for {other.id}"
        problems = map(self._airspace.problem, map(point_of, order["stops"]))
        return next((problem for problem in problems if problem is not None), None)

    def attach(self, id: str, report: Report) -> None:
        """Call a listener when a job ends, or now if it has; unknown jobs are ignored."""
        known = self._known.get(id)
        if known is None:
            return
        if known.flies:
            self._listeners[id] = report
        elif known.state in _ENDED:
            self._post(known.drone, partial(report, reported_result(known)))

    def forget(self, id: str) -> None:
        """Drop a job that does not fly: its id may be used again."""
        known = self._known.get(id)
        if known is None or known.flies:
            return
        del self._known[id]
        self.beside.pop(id, None)
        if self._current.get(known.drone) is known:
            del self._current[known.drone]
        if self._ledger is not None:
            self._ledger.forget(id)

    def break_off(self, drone: str) -> None:
        """Abort a drone's job, if it has one: it is not reported any more."""
        job = self._current.pop(drone, None)
        if job is not None:
            self._break_off(job)
            if self._ledger is None:
                self._known.pop(job.id, None)

    def _break_off(self, job: Entry) -> None:
        """Abort a job; an action that has begun may have been done, or not."""
        job.flies = False
        self._listeners.pop(job.id, None)
        if job.state is not JobState.BEGUN:
            job.state = JobState.BROKEN_OFF

    def is_flown_by(self, drone: str) -> bool:
        """Return whether a drone flies a job now."""
        job = self._current.get(drone)
        return job is not None and job.flies

    def moves_on(self, drone: str) -> None:
        """Called when a drone leaves the place where it hovered for an action of the app's own."""
        job = self._current.get(drone)
        if job is not None and not job.flies:
            del self._current[drone]
            self._break_off(job)

    # Listeners

    def mute(self) -> None:
        """Drop all listeners; the jobs go on."""
        self._listeners.clear()

    def leave(self) -> None:
        """Record nothing any more: the gateway has ended."""
        self.mute()
        for job in self._current.values():
            job.flies = False

    # What comes of them

    def _begins(self, job: Entry, action: str) -> None:
        """Called right before an action is done: records that first."""
        job.state = JobState.BEGUN
        try:
            self.write(job)
        except OSError as error:
            job.state = JobState.FLYING
            reason = f"{action} was not begun: it cannot be written down before: {error}"
            raise FlightFailed(Failure.REFUSED, reason) from error

    def _ended(self, job: Entry, hovers: bool, result: object) -> None:
        """Called with the outcome; if no action had begun, that need not be durable."""
        if not job.flies:
            return
        job.flies = False
        begun = job.state is JobState.BEGUN
        if isinstance(result, FlightFailed):
            job.state = JobState.FAILED
            job.failure = result.failure.name
            job.reason = str(result)
        else:
            job.state = JobState.DONE
            job.value = result
        listener = self._listeners.pop(job.id, None)
        if self._ledger is None:
            self._known.pop(job.id, None)
            self.beside.pop(job.id, None)
        elif begun:
            self._keep(job)
        if not (hovers and job.state is JobState.DONE):
            self._current.pop(job.drone, None)
        if listener is not None:
            listener(result)

    def write(self, job: Entry) -> None:
        """Record a job's state durably."""
        if self._ledger is not None:
            self._ledger.write(job)

    # Reports of drones

    def settle(self, drones: Mapping[str, DroneReport], again: bool) -> Mapping[str, Entry]:
        """Settle actions that had begun by the drones' reports; return all jobs.

        `again`: it is not the journal's first run, so the drones may remember earlier ones.
        """
        if again:
            self._remembered = {id: drone for drone in drones.values() for id in drone.done or ()}
        if self._ledger is not None and not self._ledger.is_whole:
            for drone in drones.values():
                self._believe(drone)
        for id, job in self._known.items():
            if job.state is JobState.BEGUN and not job.flies:
                self._known[id] = self._settled(job, drones.get(job.drone))
        return self._known

    def _settled(self, job: Entry, drone: DroneReport | None) -> Entry:
        if drone is None or drone.done is None:
            return job
        if job.id in drone.done:
            state, value = JobState.DONE, drone.done[job.id]
        elif drone.reached and drone.boot == job.boot:
            state, value = JobState.BROKEN_OFF, None
        else:
            return job
        entry = Entry(id=job.id, drone=job.drone, state=state, boot=job.boot, value=value)
        self._keep(entry)
        return entry

    def _believe(self, drone: DroneReport) -> None:
        """Record what a drone says that it did, as the ledger was damaged."""
        for id in drone.done or ():
            if id not in self._known:
                self._known[id] = entry = _done(id, drone)
                self._keep(entry)

    def _keep(self, job: Entry) -> None:
        """Record an action's outcome; if that fails, its drone still remembers it."""
        with suppress(OSError):
            self.write(job)

    def _post(self, drone: str, call: Callable[[], object]) -> None:
        self._kernel.at(self._kernel.now, EventKind.FLIGHT, self._keys[drone], call)


def _done(id: str, drone: DroneReport) -> Entry:
    value = (drone.done or {})[id]
    return Entry(id=id, drone=drone.drone, state=JobState.DONE, boot=drone.boot, value=value)


_MAY_FLY = frozenset({JobState.FAILED, JobState.BROKEN_OFF})
_ENDED = frozenset({JobState.DONE, JobState.FAILED})
