"""What a brain says becomes rows: an instant each, and measurements go along with them."""

from __future__ import annotations

import json

from pluto_fleet.journal.fold import Records
from pluto_fleet.journal.recorder import Recorder
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.time.kernel import FLEET
from pluto_fleet.shared.time.told import VirtualTime


class Rows:
    """A disk that takes rows, and says nothing of them."""

    def __init__(self) -> None:
        self.rows: list[list[Event]] = []

    def add(self, row: str) -> int:
        self.rows.append(json.loads(row))
        return len(self.rows)


def event(kind: str) -> Event:
    return {"t": 1.0, "event": kind, "how": "land"}


def pass_time(kernel: VirtualTime) -> None:
    kernel.run(kernel.spawn(kernel.sleep(1), FLEET, "time passes"))


def test_a_measurement_waits_for_the_next_row() -> None:
    """So it costs no write of its own, and no order waits for it."""
    kernel, disk = VirtualTime(), Rows()
    recorder = Recorder(kernel, disk, Records())
    recorder.measure(event("drone.flew"))
    pass_time(kernel)
    assert disk.rows == []
    recorder.take(event("stopped"))
    pass_time(kernel)
    assert disk.rows == [[event("drone.flew"), event("stopped")]]
    recorder.finish()
    assert len(disk.rows) == 1


def test_a_call_that_waits_is_not_kept_waiting_by_a_measurement() -> None:
    kernel, called = VirtualTime(), list[str]()
    recorder = Recorder(kernel, Rows(), Records())
    recorder.measure(event("drone.flew"))
    recorder.when_durable(lambda: called.append("at once"))
    pass_time(kernel)
    assert called == ["at once"]


def test_what_is_left_at_the_end_is_written_then() -> None:
    kernel, disk, records = VirtualTime(), Rows(), Records()
    recorder = Recorder(kernel, disk, records)
    recorder.measure(event("drone.flew"))
    recorder.finish()
    assert disk.rows == [[event("drone.flew")]]
    before = json.dumps(records.data)
    records.take({**event("drone.flew"), "t": 0.0})
    assert json.dumps(records.data) == before  # nothing follows from it when it is read again
