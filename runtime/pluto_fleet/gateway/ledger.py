"""What must be remembered of jobs, whatever becomes of the process that gave them."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import Protocol

from ..jobs.reports import Entry, JobState


class Written(Protocol):
    """A job, as far as it is written down."""

    @property
    def id(self) -> str:
        """The job's own."""
        ...

    @property
    def drone(self) -> str:
        """Who flies it."""
        ...

    @property
    def state(self) -> JobState:
        """How far it has come."""
        ...

    @property
    def boot(self) -> int:
        """The drone's, when the job was given."""
        ...

    @property
    def value(self) -> object:
        """What its action gave, once it is done."""
        ...

    @property
    def failure(self) -> str:
        """The name of the `Failure`, once it has failed."""
        ...

    @property
    def reason(self) -> str:
        """Why it failed, for a person."""
        ...


class Ledger(Protocol):
    """Keeps of each job whose action has begun how it stands; what is kept is there for good."""

    @property
    def is_whole(self) -> bool:
        """Whether all that was ever kept can be read."""
        ...

    def entries(self) -> Iterator[Entry]:
        """Yield what is kept, in the order in which the jobs were given."""
        ...

    def write(self, job: Written) -> None:
        """Keep how a job stands; when this returns, it is kept. `OSError`: it is not."""
        ...

    def forget(self, id: str) -> None:
        """Drop a job: nobody will ask for it any more."""
        ...

    @property
    def cut(self) -> Collection[str]:
        """The drones whose motors are cut."""
        ...

    def write_cut(self, drone: str, is_cut: bool) -> None:
        """Keep whether a drone's motors are cut; if the computer dies, only after `make_sure`.

        Waits for no disk, for motors are cut right after that. `OSError`: it is not kept.
        """
        ...

    def make_sure(self) -> None:
        """Return when all is kept, whatever dies. `OSError`: perhaps not."""
        ...


class MemoryLedger:
    """A ledger for simulations and tests: it outlives a simulated gateway, not the process."""

    is_whole = True

    def __init__(self) -> None:
        self._kept: dict[str, tuple[str, JobState, int, object, str, str]] = {}
        self.cut: dict[str, None] = {}

    def entries(self) -> Iterator[Entry]:
        """Yield what is kept, in the order in which the jobs were given."""
        for id, (drone, state, boot, value, failure, reason) in self._kept.items():
            yield Entry(
                id=id,
                drone=drone,
                state=state,
                boot=boot,
                value=value,
                failure=failure,
                reason=reason,
            )

    def write(self, job: Written) -> None:
        """Keep how a job stands."""
        self._kept[job.id] = (job.drone, job.state, job.boot, job.value, job.failure, job.reason)

    def forget(self, id: str) -> None:
        """Drop a job: nobody will ask for it any more."""
        self._kept.pop(id, None)

    def write_cut(self, drone: str, is_cut: bool) -> None:
        """Keep whether a drone's motors are cut."""
        if is_cut:
            self.cut[drone] = None
        else:
            self.cut.pop(drone, None)

    def make_sure(self) -> None:
        """All is kept already."""
