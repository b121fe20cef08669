"""Events over restarts: killed at any moment, the app has each of them once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.shared.brain import Brain
from tests.brain.events.test_events import app_with
from tests.brain.hand import charged, settled

IDS = ("door", "window", "roof")


class Disk:
    """The rows that are durable, of a brain that may be killed."""

    def __init__(self) -> None:
        self.rows: dict[str, dict[Any, Any]] = {
            "mission": {},
            "trip": {},
            "drone": {},
            "happening": {},
        }
        self.results: list[Any] = []

    def write(self, brain: Brain) -> None:
        """Write what has changed, and tell the brain that it is durable."""
        for table, key, row in brain.rows():
            if table == "result":
                self.results.append(row)
            else:
                self.rows[table][key] = row
        brain.tell({"durable": 1_000_000}, 0.0)

    def standing(self) -> Mapping[str, Any]:
        """Return all that a later brain goes on from."""
        missions: dict[str, dict[str, Any]] = {}
        for (name,), row in self.rows["mission"].items():
            missions[name] = {**row, "todo": [], "done": [], "gone": []}
        for (name, _), row in sorted(
            self.rows["trip"].items(), key=lambda item: item[1].get("rank", 0)
        ):
            done = row.get("status") == "COMPLETED"
            missions[name]["done" if done else "todo"].append(row)
        return {
            "missions": missions,
            "drones": {id: row for (id,), row in self.rows["drone"].items()},
            "results": self.results,
            "happenings": {id: row for (id,), row in self.rows["happening"].items()},
        }


ACTS = st.lists(
    st.one_of(
        st.tuples(st.just("raise"), st.sampled_from(IDS)),
        st.tuples(st.sampled_from(("write", "settle", "kill")), st.just("")),
    ),
    max_size=25,
)


@given(ACTS)
def test_each_has_happened_once(acts: list[tuple[str, str]]) -> None:
    disk = Disk()
    raised: set[str] = set()
    durable: set[str] = set()
    brain = charged(app=app_with(), recorded=True)
    for act, id in [*acts, ("settle", ""), ("write", ""), ("settle", "")]:
        if act == "raise":
            request = {"command": "raise", "event": "intruder", "id": id, "at": [4.0, 2.0]}
            brain.command(request, 0.0)
            raised.add(id)
        elif act == "settle":
            settled(brain, 0.0)
        elif act == "write":
            disk.write(brain)
            durable |= raised
        else:
            raised = {*durable}
            brain = charged(app=app_with(), recorded=True)
            brain.restore(disk.standing(), 0.0)
            brain.go_on(brain.standing()["missions"], {"cf1": {}}, 0.0)
    rows = brain.standing()["happenings"]
    assert {*rows} == raised
    assert not any(row["open"] for row in rows.values())
    missions = [name for row in rows.values() for name in row["made"]]
    assert sorted(missions) == sorted({*missions}) == sorted(brain.standing()["missions"])
