"""The result of the exploration: the places where missions can be, and the paths to them.

A place inside a fork belongs to a branch, as a statement belongs to a function: the branch is
entered where the mission forks, and left at the gate, towards wherever the fork was entered from.

Places are tuples, as they are looked up by the million, and tuples are the fastest to hash.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import groupby
from typing import NamedTuple

import networkx as nx

from plutoc.block import IN_GRAPH
from plutoc.graph.model import Edge, Graph
from plutoc_runtime.domain.status import Status

Fork = tuple[str, Status]
"""A block, and a status of it that several edges take."""


class Facts(NamedTuple):
    """The facts about a mission's past that matter for its future."""

    allocated: bool = False
    """Whether it has a drone that was not launched yet."""
    launched: bool = False
    """Whether it was launched at least once."""
    outcome: Status | None = None
    """How the trip in flight will end. Every branch of a fork sees that same end, so it is chosen
    at the launch, once for all of them; None before the first launch and once the trip is over."""
    attempts: int = 0
    """The least number of flights of the next trip: a bound that was reached once stays so."""
    spent: bool = False
    """Whether it has FAILED with no trip left to fly, so that nothing can be retried."""
    said: int = 0
    """Remembered answers of blocks, two bits each."""


class Split(NamedTuple):
    """A fork, with the facts of the missions that reach it."""

    node: str
    status: Status
    facts: Facts

    @property
    def fork(self) -> Fork:
        """The fork alone."""
        return self.node, self.status


class Frame(NamedTuple):
    """One branch of a fork, by its number in the order of the source."""

    split: Split
    branch: int


class Place(NamedTuple):
    """A mission, or a clone of it, arrives at a block or at `end`."""

    frame: Frame | None
    """The innermost branch that it is in; None outside all forks."""
    node: str
    status: Status
    facts: Facts
    out: bool = False
    """Whether it has just left its branch: at the gate, or, by mistake, at a block that flies it."""


Loop = tuple[Place, ...]
"""Places in the order of discovery."""


class Step(NamedTuple):
    """How a place was first reached, on the shortest path."""

    before: Place
    leaving: Status | None
    """The status on the edge; None where a branch is left, which happens within a block."""
    enters: bool = False
    """A branch begins here."""
    back_to: Place | None = None
    """A branch is left here: its fork began at that place."""


class Hop(NamedTuple):
    """One block on a path, and the status with which the mission leaves it."""

    node: str
    leaving: Status | None


Way = tuple[Hop, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Flow:
    """The result of the exploration. Mappings are in the order of discovery."""

    graph: Graph
    edges: tuple[Edge, ...]
    """Those that were walked: all but the ones that `start` and the creator forbid."""
    arrows: nx.DiGraph
    """The same, from block to block by name."""
    places: Mapping[Place, Step | None]
    after: nx.DiGraph
    """The successors of each place."""
    loose: tuple[tuple[Place, Status], ...]
    """Places left with a status that no edge takes."""
    endless: tuple[Loop, ...]
    """The loops that are never left. A way comes to its end where nothing follows, or where some
    status is left without an edge, even if that is a mistake of its own."""
    entries: Mapping[Split, tuple[Place, ...]]
    """The places where each fork begins."""
    nearest: Mapping[str, Place]
    """The place of each block that is reached by the shortest way."""
    arrives: Mapping[str, frozenset[Status]]
    leaves: Mapping[str, frozenset[Status]]
    carries: Mapping[Edge, frozenset[Status]]

    def branches(self, node: str, status: Status) -> tuple[Edge, ...]:
        """The edges that this status was seen to take from this block."""
        return tuple(e for e in self.graph.outgoing[node] if status in self.carries[e])

    def way_to(self, node: str, leaving: Status | None = None) -> Way:
        """Return the shortest path to a block, and on with a status if one is given."""
        if leaving is None:
            return self.way(self.nearest[node])
        lost = (p for p, s in self.loose if p.node == node and s is leaving)
        return self.way(next(lost, self.nearest[node]), leaving)

    def way(self, place: Place, leaving: Status | None = None) -> Way:
        """Return the shortest path to a place, from the creation of missions."""
        hops = [Hop(node=place.node, leaving=leaving)]
        begun: list[Place] = []
        while (step := self.places[place]) is not None:
            if step.back_to is not None:
                begun.append(step.back_to)
            # a gate leads back to the fork of this very mission
            before = begun.pop() if step.enters and begun else step.before
            if step.leaving is not None:
                hops.append(Hop(node=before.node, leaving=step.leaving))
            place = before
        return tuple(reversed(hops))


def blocks_of(places: Iterable[Place]) -> tuple[str, ...]:
    """Return the blocks of a path, each once: arrival and departure at a gate are one."""
    return tuple(name for name, _ in groupby(place.node for place in places))


def ordered(statuses: Iterable[Status]) -> tuple[Status, ...]:
    """Return the statuses in declared order."""
    known = frozenset(statuses)
    return tuple(status for status in IN_GRAPH if status in known)


def is_final(status: Status) -> bool:
    """Whether a mission can end with this status."""
    return status in (Status.COMPLETED, Status.FAILED)
