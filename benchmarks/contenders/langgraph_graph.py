"""LangGraph: one compiled StateGraph, invoked once a mission; nothing is checkpointed.

It knows no gate that lets the first branch pass: both monitors run in one step and end with it.
"""

from __future__ import annotations

import asyncio
from typing import TypedDict

from langgraph.graph import END, START, StateGraph

from . import ideal
from .futures import Fleet, launch
from .process import Notes, main
from .work import Done, Work

STEPS = {"recursion_limit": 100_000}


class Mission(TypedDict, total=False):
    """What the nodes read and write."""

    id: int
    trips: int
    trip: int
    attempt: int
    priority: int
    drone: int
    flight: asyncio.Future[bool]
    ok: bool
    status: int
    done_trips: int
    failed_trips: int


class Nodes:
    """The blocks."""

    def __init__(self, fleet: Fleet) -> None:
        self.fleet = fleet

    async def allocate(self, m: Mission) -> Mission:
        """Wait for a drone."""
        return {"drone": await self.fleet.acquire(m["priority"])}

    async def launch(self, m: Mission) -> Mission:
        """Let it go."""
        flight = launch(m["id"], m["trip"], m["attempt"])
        return {"flight": flight, "status": ideal.RUNNING}

    async def watch(self, m: Mission) -> Mission:
        """Wait for the end of the flight."""
        return {"ok": await m["flight"]}

    async def timer(self, m: Mission) -> Mission:
        """Wait for it as well."""
        await m["flight"]
        return {}

    async def first(self, m: Mission) -> Mission:
        """The flight is over."""
        self.fleet.release(m["drone"])
        if not m["ok"]:
            failed = m["failed_trips"] + 1
            return {"status": ideal.FAILED, "drone": -1, "failed_trips": failed}
        trip = m["trip"] + 1
        return {
            "status": ideal.STANDBY if trip < m["trips"] else ideal.COMPLETED,
            "trip": trip,
            "attempt": 0,
            "drone": -1,
            "done_trips": m["done_trips"] + 1,
        }

    async def retry(self, m: Mission) -> Mission:
        """Try it once more."""
        return {"priority": m["priority"] + 1, "attempt": m["attempt"] + 1}

    async def judge(self, m: Mission) -> Mission:
        """Accept every mission."""
        return {}

    async def again(self, m: Mission) -> Mission:
        """Repeat no mission."""
        return {}


async def all_flows(work: Work) -> Done:
    """Fly all missions side by side."""
    nodes, graph = Nodes(Fleet(work.drones)), StateGraph(Mission)
    for node in (
        nodes.allocate,
        nodes.launch,
        nodes.watch,
        nodes.timer,
        nodes.first,
        nodes.retry,
        nodes.judge,
        nodes.again,
    ):
        graph.add_node(node.__name__, node)
    graph.add_edge(START, "allocate")
    graph.add_edge("allocate", "launch")
    graph.add_edge("launch", "watch")
    graph.add_edge("launch", "timer")
    graph.add_edge(["watch", "timer"], "first")
    ways = {ideal.STANDBY: "allocate", ideal.FAILED: "retry", ideal.COMPLETED: "judge"}
    graph.add_conditional_edges("first", lambda m: m["status"], ways)
    graph.add_edge("retry", "allocate")
    graph.add_edge("judge", "again")
    graph.add_edge("again", END)
    app = graph.compile()
    missions = await asyncio.gather(
        *(app.ainvoke(begun(n, work.trips), STEPS) for n in range(work.missions))
    )
    return Done(
        missions=sum(m["status"] == ideal.COMPLETED for m in missions),
        completed=sum(m["done_trips"] for m in missions),
        failed=sum(m["failed_trips"] for m in missions),
    )


def begun(number: int, trips: int) -> Mission:
    """Return a mission that has not flown yet."""
    return {
        "id": number,
        "trips": trips,
        "trip": 0,
        "attempt": 0,
        "priority": 0,
        "drone": -1,
        "done_trips": 0,
        "failed_trips": 0,
    }


def fly(work: Work, notes: Notes) -> Done:
    """Do the work once."""
    return asyncio.run(all_flows(work))


if __name__ == "__main__":
    main(fly)
