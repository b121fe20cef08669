"""The jobs of the drones, identified by their ids, so that no action is done twice."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

from ..jobs.reports import DroneReport, Entry, JobState, reported_result
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.time.kernel import EventKind, Kernel, Key

if TYPE_CHECKING:
    from ..jobs.flown import Flown
    from ..jobs.job import Job, Report
    from ..shared.domain.actions import Plain
    from ..shared.domain.model import Item
    from .envelope import Envelope
    from .ledger import Ledger


class AssignedJob:
    """A job that was given to a drone; passed to navigation instead of the brain's own."""

    __slots__ = (
        "_job",
        "_jobs",
        "action",
        "beside",
        "boot",
        "drone",
        "failure",
        "id",
        "listener",
        "reason",
        "state",
        "stops",
        "value",
    )

    def __init__(self, jobs: Jobs, job: Job, listener: Report, boot: int) -> None:
        self._jobs, self.boot = jobs, boot
        self._job: Job | None = job
        self.listener: Report | None = listener
        self.id, self.drone, self.stops, self.action = job.id, job.drone, job.stops, job.action
        self.beside = job.beside
        self.state = JobState.FLYING
        self.value: object = None
        self.failure = self.reason = ""

    @property
    def parameters(self) -> Mapping[str, Plain]:
        """The parameters of the action."""
        return self._known.parameters

    @property
    def item(self) -> Item | None:
        """The item to pick or release."""
        return self._known.item

    @property
    def seconds(self) -> float:
        """The expected duration of the action."""
        return self._known.seconds

    @property
    def _known(self) -> Job:
        if self._job is None:
            raise RuntimeError(f"the job {self.id} is over")
        return self._job

    @property
    def flies(self) -> bool:
        """Whether navigation is executing it, and will report."""
        return self._job is not None

    @property
    def hovers(self) -> bool:
        """Whether its drone has arrived, and hovers there for an action of the app's own."""
        return self.action is None and self.state is JobState.DONE

    def begins(self) -> None:
        """Called right before the action is done: records that first."""
        job = self._known
        self.state = JobState.BEGUN
        try:
            self._jobs.write(self.entry)
        except OSError as error:
            self.state = JobState.FLYING
            reason = f"{self.action} was not begun: it cannot be written down before: {error}"
            raise FlightFailed(Failure.REFUSED, reason) from error
        job.begins()

    def report(self, result: object) -> None:
        """Called with its outcome, which is passed on to the listener."""
        if self._job is None:
            return
        self._job, begun = None, self.state is JobState.BEGUN
        if isinstance(result, FlightFailed):
            self.state, self.failure = JobState.FAILED, result.failure.name
            self.reason = str(result)
        else:
            self.state, self.value = JobState.DONE, result
        self._jobs.ended(self, begun)
        if self.listener is not None:
            self.listener(result)

    def leave(self) -> None:
        """Ignore further reports."""
        self._job = self.listener = None

    def break_off(self) -> None:
        """Abort it; an action that has begun may have been done, or not."""
        self.leave()
        if self.state is JobState.FLYING or self.hovers:
            self.state = JobState.BROKEN_OFF

    @property
    def entry(self) -> Entry:
        """Its entry in the ledger."""
        return Entry(
            id=self.id,
            drone=self.drone,
            state=self.state,
            boot=self.boot,
            flies=self.flies,
            value=self.value,
            failure=self.failure,
            reason=self.reason,
        )


class Jobs:
    """All jobs that the brain may still ask for."""

    def __init__(
        self,
        kernel: Kernel,
        fly: Callable[[Job, Report], None],
        keys: Mapping[str, Key],
        envelope: Envelope,
        ledger: Ledger | None,
    ) -> None:
        self._kernel, self._fly, self._keys = kernel, fly, keys
        self._envelope, self._ledger = envelope, ledger
        self._known: dict[str, AssignedJob | Entry] = {}
        """By their ids; an `Entry` is finished, or from an earlier run of the gateway."""
        if ledger is not None:
            self._known.update((entry.id, entry) for entry in ledger.entries())
        self._remembered: dict[str, DroneReport] = {}
        """The drone that reports a job as done, by the job's id: it may be the only record."""
        self._current: dict[str, AssignedJob] = {}
        """The current job of each drone, by the drones' ids."""
        self.beside: dict[str, Flown] = {}
        """What was told of those whose action is done beside its target, by their ids."""
        self.boots = dict.fromkeys(keys, 0)
        """The drones' boot numbers in their latest reports."""

    # Requests of the brain

    def fly(self, job: Job, report: Report) -> None:
        """Give a drone its job, unless its action was done before, or may have been."""
        drone = job.drone
        given = AssignedJob(self, job, report, self.boots[drone])
        known = self._known.get(given.id)
        if known is None and given.id in self._remembered:
            known = self._known[given.id] = _done(given.id, self._remembered[given.id])
        if known is not None and known.state not in _MAY_FLY:
            self._repeated(known, report)
            return
        problem = self._problem(given)
        if problem is not None:
            self._post(drone, partial(report, FlightFailed(Failure.REFUSED, problem)))
            return
        self._known[given.id] = self._current[drone] = given
        self._fly(given, given.report)

    def _repeated(self, known: AssignedJob | Entry, report: Report) -> None:
        """Answer a repeated job by what is known of it, never by a flight."""
        if known.state is JobState.BEGUN and not known.flies:
            reason = f"it cannot be told whether the action of {known.id} was done"
            self._post(known.drone, partial(report, FlightFailed(Failure.UNKNOWN, reason)))
        else:
            self.attach(known.id, report)

    def _problem(self, job: AssignedJob) -> str | None:
        other = self._current.get(job.drone)
        if other is not None and other.flies:
            return f"{job.drone} flies already, for {other.id}"
        return self._envelope.problem(job.stops)

    def attach(self, id: str, report: Report) -> None:
        """Call a listener when a job ends, or now if it has; unknown jobs are ignored."""
        known = self._known.get(id)
        if isinstance(known, AssignedJob) and known.flies:
            known.listener = report
        elif known is not None and known.state in _ENDED:
            self._post(known.drone, partial(report, reported_result(_entry(known))))

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
            job.break_off()
            if self._ledger is None:
                self._known.pop(job.id, None)

    def is_flown_by(self, drone: str) -> bool:
        """Return whether a drone flies a job now."""
        job = self._current.get(drone)
        return job is not None and job.flies

    def moves_on(self, drone: str) -> None:
        """Called when a drone leaves the place where it hovered for an action of the app's own."""
        job = self._current.get(drone)
        if job is not None and job.hovers:
            del self._current[drone]
            job.break_off()

    # Listeners

    def mute(self) -> None:
        """Drop all listeners; the jobs go on."""
        for job in self._current.values():
            job.listener = None

    def leave(self) -> None:
        """Record nothing any more: the gateway has ended."""
        for job in self._current.values():
            job.leave()

    # Called by jobs

    def write(self, job: Entry) -> None:
        """Record a job's state durably."""
        if self._ledger is not None:
            self._ledger.write(job)

    def ended(self, job: AssignedJob, begun: bool) -> None:
        """Called when a job has ended; if no action had begun, that need not be durable."""
        if self._ledger is None:
            self._known.pop(job.id, None)
            self.beside.pop(job.id, None)
        elif begun:
            self._keep(job.entry)
        if not job.hovers:
            self._current.pop(job.drone, None)

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
        return {id: _entry(job) for id, job in self._known.items()}

    def _settled(self, job: AssignedJob | Entry, drone: DroneReport | None) -> AssignedJob | Entry:
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
        self._kernel.schedule(self._kernel.now, EventKind.FLIGHT, self._keys[drone], call)


def _done(id: str, drone: DroneReport) -> Entry:
    value = (drone.done or {})[id]
    return Entry(id=id, drone=drone.drone, state=JobState.DONE, boot=drone.boot, value=value)


def _entry(job: AssignedJob | Entry) -> Entry:
    return job.entry if isinstance(job, AssignedJob) else job


_MAY_FLY = frozenset({JobState.FAILED, JobState.BROKEN_OFF})
_ENDED = frozenset({JobState.DONE, JobState.FAILED})
