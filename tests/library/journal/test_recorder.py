"""What a brain says becomes entries: an instant each, and measurements go along with them."""

from __future__ import annotations

import json

from pluto_fleet.journal.recorder import Recorder
from pluto_fleet.journal.standing import Row, Standing
from pluto_fleet.journal.store import Entry
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.time.kernel import FLEET
from pluto_fleet.shared.time.told import VirtualTime


class Disk:
    """A disk that takes entries, and says nothing of them."""

    def __init__(self) -> None:
        self.events: list[list[Event]] = []
        self.rows: list[list[Row]] = []

    def add(self, entry: Entry) -> int:
        self.events.append(json.loads(entry.events))
        self.rows.append(list(entry.rows))
        return len(self.events)


def none_changed() -> list[Row]:
    return []


def event(kind: str) -> Event:
    return {"t": 1.0, "event": kind, "how": "land"}


def pass_time(kernel: VirtualTime) -> None:
    kernel.run(kernel.spawn(kernel.sleep(1), FLEET, "time passes"))


def test_a_measurement_waits_for_the_next_entry() -> None:
    """So it costs no write of its own, and no order waits for it."""
    kernel = VirtualTime()
    disk = Disk()
    recorder = Recorder(kernel, disk, Standing(), none_changed)
    recorder.measure(event("drone.flew"))
    pass_time(kernel)
    assert disk.events == []
    recorder.take(event("stopped"))
    pass_time(kernel)
    assert disk.events == [[event("drone.flew"), event("stopped")]]
    recorder.finish()
    assert len(disk.events) == 1


def test_a_call_that_waits_is_not_kept_waiting_by_a_measurement() -> None:
    kernel, called = VirtualTime(), list[str]()
    recorder = Recorder(kernel, Disk(), Standing(), none_changed)
    recorder.measure(event("drone.flew"))
    recorder.when_durable(lambda: called.append("at once"))
    pass_time(kernel)
    assert called == ["at once"]


def test_what_is_left_at_the_end_is_written_then() -> None:
    kernel = VirtualTime()
    disk = Disk()
    recorder = Recorder(kernel, disk, Standing(), none_changed)
    recorder.measure(event("drone.flew"))
    recorder.finish()
    assert disk.events == [[event("drone.flew")]]


def test_the_rows_of_an_instant_are_written_with_its_events() -> None:
    kernel = VirtualTime()
    disk = Disk()
    standing = Standing()
    changed: list[Row] = [("drone", ("cf1",), {"trips": 1})]

    def rows() -> list[Row]:
        taken = changed[:]
        changed.clear()
        return taken

    recorder = Recorder(kernel, disk, standing, rows)
    recorder.take(event("stopped"))
    recorder.fact("stopped", 1.0)
    assert disk.rows == []
    pass_time(kernel)
    assert disk.rows == [[("drone", ("cf1",), {"trips": 1}), ("app", ("stopped",), {"is": 1.0})]]
    assert (standing.stopped, standing.flown) == (True, {"cf1": 1})
