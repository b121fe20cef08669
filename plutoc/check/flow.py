"""Where missions can be in a graph: what the walk over all statuses found, and the ways there.

A place inside a fork belongs to a branch, as a statement belongs to a function: the branch is
entered where the mission forks, and left at the gate, towards wherever the fork was entered from.

Places are looked up by the million, and so are tuples: to hash those is quicker than anything else.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import groupby
from typing import NamedTuple

import networkx as nx

from plutoc.graph.model import Edge, Graph
from plutoc_runtime.domain.status import IN_GRAPH, Status

Fork = tuple[str, Status]
"""A block, and a status of it that several edges take."""


class Facts(NamedTuple):
    """What a mission has behind it."""

    allocated: bool = False
    """It got a drone, and has not been launched since."""
    launched: bool = False
    """It was launched at least once."""
    outcome: Status | None = None
    """How the trip in flight will end. Every branch of a fork sees that same end, so it is chosen
    at the launch, once for all of them; None before the first launch and once the trip is over."""
    attempts: int = 0
    """At least so often the next trip has been flown: a bound that gave up once gives up again."""
    spent: bool = False
    """It has FAILED though no trip was left to fly, so nothing can be put back."""
    said: int = 0
    """What blocks have said that say the same until something is flown: two bits each."""


class Split(NamedTuple):
    """A fork, and what the missions that come to it have behind them."""

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
    """Here it has just left its branch: at the gate, or, by mistake, at a block that flies it."""


Loop = tuple[Place, ...]
"""Places in the order of discovery."""


class Step(NamedTuple):
    """How a place was first reached, by the shortest way."""

    before: Place
    leaving: Status | None
    """The status on the edge; None where a branch is left, which happens within a block."""
    enters: bool = False
    """A branch begins here."""
    back_to: Place | None = None
    """A branch is left here: its fork began at that place."""


class Hop(NamedTuple):
    """One block on a way, and the status that the mission leaves it with."""

    node: str
    leaving: Status | None


Way = tuple[Hop, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Flow:
    """Everything that the walk found. Mappings are in the order of discovery."""

    graph: Graph
    edges: tuple[Edge, ...]
    """Those that were walked: all but the ones that `start` and the creator forbid."""
    arrows: nx.DiGraph
    """The same, from block to block by name."""
    places: Mapping[Place, Step | None]
    after: nx.DiGraph
    """Where missions go next from each place."""
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
        """Return the shortest way to a block, and on with that status if one is given."""
        if leaving is None:
            return self.way(self.nearest[node])
        lost = (p for p, s in self.loose if p.node == node and s is leaving)
        return self.way(next(lost, self.nearest[node]), leaving)

    def way(self, place: Place, leaving: Status | None = None) -> Way:
        """Return the shortest way to a place, from where missions are made."""
        hops = [Hop(node=place.node, leaving=leaving)]
        begun: list[Place] = []
        while (step := self.places[place]) is not None:
            if step.back_to is not None:
                begun.append(step.back_to)
            # a gate leads back to the fork that this very mission came from, not to any
            before = begun.pop() if step.enters and begun else step.before
            if step.leaving is not None:
                hops.append(Hop(node=before.node, leaving=step.leaving))
            place = before
        return tuple(reversed(hops))


def blocks_of(places: Iterable[Place]) -> tuple[str, ...]:
    """Return the blocks of a way, each once: a gate is come to and left at one block."""
    return tuple(name for name, _ in groupby(place.node for place in places))


def ordered(statuses: Iterable[Status]) -> tuple[Status, ...]:
    """Return the statuses in declared order."""
    known = frozenset(statuses)
    return tuple(status for status in IN_GRAPH if status in known)


def is_final(status: Status) -> bool:
    """Can a mission end with this status?"""
    return status in (Status.COMPLETED, Status.FAILED)
