"""A graph that has passed its checks, with what they found out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from plutoc.graph.model import Edge, Graph
from plutoc_runtime.domain.status import Status


@dataclass(frozen=True, slots=True, kw_only=True)
class Fork:
    """One status of one block that two or more edges take: a clone of the mission on each."""

    node: str
    status: Status
    branches: tuple[Edge, ...]
    """In the order of the source: that is the order of the branches."""
    gate: str
    """The block at which every branch closes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Checked:
    """A sound graph, with the results of the checks, which include missions resumed after a Stop."""

    graph: Graph
    arrives: Mapping[str, frozenset[Status]]
    """The statuses with which missions can reach each block, and `end`."""
    leaves: Mapping[str, frozenset[Status]]
    """The statuses with which they can leave it."""
    carries: Mapping[Edge, frozenset[Status]]
    """The statuses that really pass along each edge."""
    forks: tuple[Fork, ...]
    implicit_ends: tuple[tuple[str, Status], ...]
    """Where a mission ends without an edge to `end`."""
    resumes: Mapping[str, tuple[str, ...]]
    """Where a mission resumes that was stopped at each block, which may depend on its path."""
    entries: Mapping[str, frozenset[Status]]
    """The blocks at which interrupted missions go on, in the order of the source, and how they
    stand then."""
    explored: int
    """How many states of a mission were explored, which determines the cost of the checks."""
