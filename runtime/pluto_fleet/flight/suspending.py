"""Taking one mission out of its graph, finding out what came of its flight, and letting it go on."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

from ..jobs.reports import reported_result, result_data
from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted
from ..shared.time.kernel import FLEET, Future, Task
from .mission_status import aside
from .reconcile import (
    PROBED,
    Outcome,
    id_of,
    in_flight,
    outcome_of,
    question,
    trip_of,
)

if TYPE_CHECKING:
    from ..jobs.reports import Entry
    from ..journal.standing import Record
    from .recorded_brain import RecordedBrain

Then = Callable[[str, "Record"], None]


class Suspending:
    """The missions of one run that are out of their graphs, or about to be."""

    def __init__(self, run: RecordedBrain) -> None:
        self._run, self._link = run, run.link
        self._busy = False
        """Whether a command is half done: missions may be in no graph that are about to go on."""
        self._steps_out: dict[str, Task[None]] = {}
        """The tasks of missions whose flights are being aborted."""
        self._probes: dict[str, Future[bool | None]] = {}
        """The flights whose outcomes the app is asked for, by their ids."""

    def _step_out(self, name: str, record: Record, then: Then) -> None:
        """Suspend a mission; continue when the outcome of its flight is known."""
        self._refuse_while_it_steps_out(name)
        flight, was_aside = in_flight(record), aside(record) is not None
        with self._half_done():
            if not was_aside:
                self._run.command("leave", mission=name)
            if flight is None or was_aside:
                then(name, record)
            else:
                self._steps_out[name] = self._run.kernel.spawn(
                    self._broken_off(name, record, then), FLEET, f"{name} is interrupted"
                )

    def _look_into(self, name: str, record: Record) -> None:
        """Find out what came of a flight of which no report comes; its mission goes on if that is known."""
        self._step_out(name, record, self._resume)

    @contextmanager
    def _half_done(self) -> Iterator[None]:
        """Let nothing end meanwhile."""
        was_busy = self._busy
        self._busy = True
        try:
            yield
        finally:
            self._busy = was_busy
        self._run.look_for_the_end()

    def _refuse_while_it_steps_out(self, name: str) -> None:
        if name in self._steps_out:
            raise BadInput(
                f"mission {quoted(name)} is just being interrupted: its drone is asked what it has "
                "done; try again in a moment"
            )

    async def _broken_off(self, name: str, record: Record, then: Then) -> None:
        """Find out the outcome of a flight from the ledger and the drone."""
        flight = record["flight"]
        entry = (await self._link.fleet_report()).jobs.get(id_of(name, flight))
        what = outcome_of(entry, self._run.repeat_of(record), bool(flight["begun"]))
        if what is Outcome.UNKNOWN:
            what = await self.probe(name, record)
        with self._half_done():
            del self._steps_out[name]
            self._take_outcome(name, record, what, entry, then)

    def _take_outcome(
        self, name: str, record: Record, what: Outcome, entry: Entry | None, then: Then
    ) -> None:
        """Have the brain know what came of a flight that was broken off, and go on with its mission."""
        if self._run.record(name)["ended"]:
            return  # it has ended meanwhile
        if what is Outcome.UNKNOWN:
            self.doubt(name, record)
            return
        if what is Outcome.FLIES_ON and entry is not None:  # it has just ended
            told = result_data(reported_result(entry))
            self._run.command("settle", mission=name, done=True, **told)
        else:
            self._settle(name, record, what)
        record = self._run.record(name)
        if not record["ended"]:
            then(name, record)

    def _settle(self, name: str, record: Record, what: Outcome) -> None:
        """Record whether the action of an interrupted flight was done."""
        if what is Outcome.DONE:
            self._run.command("settle", mission=name, done=True)
        else:
            self._run.interrupted(name, record["flight"])

    def _resume(self, name: str, record: Record) -> None:
        with self._half_done():
            self._run.command("resume", mission=name)
            self._go_on(name)

    def _go_on(self, name: str) -> None:
        """Give a suspended mission back to the brain."""
        self._run.driver.call(partial(self._run.brain.go_on, {name: {}}, {}))

    # What only the app, or a person, can tell

    async def probe(self, name: str, record: Record) -> Outcome:
        """Ask the app's own hook, if there is one, whether the action of a flight was done."""
        answer: Future[bool | None] = Future()
        id = id_of(name, record["flight"])
        self._probes[id] = answer
        self._run.command("probe", mission=name)
        return PROBED[await answer]

    def probed(self, flight: str, answer: bool | None) -> None:
        """Called with what the app's hook says."""
        asked = self._probes.pop(flight, None)
        if asked is not None:
            asked.set(answer)

    def doubt(self, name: str, record: Record) -> None:
        """Record that only the user can say whether the action of a suspended mission was done."""
        flight, trip = record["flight"], trip_of(record, record["flight"])
        assert trip is not None
        self._run.command("doubt", mission=name, reason=question(trip, flight["drone"]))

    def doubt_in_flight(self, name: str, id: str) -> None:
        """Suspend a mission whose flight was called off, and whose action may be done."""
        record = self._run.record(name)
        flight = in_flight(record)
        if flight is None or id_of(name, flight) != id or aside(record) is not None:
            return  # it has ended, or its mission was suspended
        if name in self._steps_out or record["ended"]:
            return
        with self._half_done():
            self._run.command("leave", mission=name)
            self.doubt(name, record)
