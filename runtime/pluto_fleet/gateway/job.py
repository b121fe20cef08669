"""A job as the gateway has it: navigation flies it, and the ledger remembers it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import Failure, FlightFailed

from ..jobs.reports import Entry, JobState

if TYPE_CHECKING:
    from plutoc_runtime.domain.actions import Plain
    from plutoc_runtime.domain.model import Item

    from ..jobs.job import Job
    from .jobs import Jobs

Report = Callable[[object], object]
"""Who hears what an action gave, or the `FlightFailed` that ended the job."""


class Given:
    """One job that was given to a drone: what navigation gets instead of the brain's own."""

    __slots__ = (
        "_job",
        "_jobs",
        "action",
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
        self.state = JobState.FLYING
        self.value: object = None
        self.failure = self.reason = ""

    @property
    def parameters(self) -> Mapping[str, Plain]:
        """How to do it."""
        return self._known.parameters

    @property
    def item(self) -> Item | None:
        """What to pick or to release."""
        return self._known.item

    @property
    def seconds(self) -> float:
        """How long the action is expected to take."""
        return self._known.seconds

    @property
    def _known(self) -> Job:
        if self._job is None:
            raise RuntimeError(f"the job {self.id} is over")
        return self._job

    @property
    def flies(self) -> bool:
        """Whether navigation has it, and will report."""
        return self._job is not None

    @property
    def hovers(self) -> bool:
        """Whether it came so far that its drone waits there, for an action of the app's own."""
        return self.action is None and self.state is JobState.DONE

    def begins(self) -> None:
        """Hear that the action is about to be done: that is written down first."""
        job = self._known
        self.state = JobState.BEGUN
        try:
            self._jobs.write(self)
        except OSError as error:
            self.state = JobState.FLYING
            reason = f"{self.action} was not begun: it cannot be written down before: {error}"
            raise FlightFailed(Failure.REFUSED, reason) from error
        job.begins()

    def report(self, result: object) -> None:
        """Hear how it ended, and tell whoever waits for that."""
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
        """Hear no more of it, whatever becomes of it."""
        self._job = self.listener = None

    def break_off(self) -> None:
        """Nobody flies it any more; an action that has begun may have been done, or not."""
        self.leave()
        if self.state is JobState.FLYING or self.hovers:
            self.state = JobState.BROKEN_OFF

    @property
    def entry(self) -> Entry:
        """What the ledger has of it."""
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
