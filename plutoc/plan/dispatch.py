"""For a chart that has no structure: a case for each spot that is jumped to.

What one arrow alone leads to is written where it is led to, so chains and branches stay together.
"""

from __future__ import annotations

from collections.abc import Mapping

from plutoc.plan.chart import Kind, Spot
from plutoc.plan.model import Body, Case, Dispatch
from plutoc.plan.shape import Shape
from plutoc.plan.structure import Context, Writer


def dispatch(found: Shape, steps: Mapping[Spot, Body], entries: tuple[str, ...] = ()) -> Body:
    """Return a chart as one dispatch over the spots that several arrows, or missions, lead to."""
    first, entered = found.chart.entry, frozenset(entries)
    places = tuple(
        spot
        for spot in found.order
        if found.arrows.in_degree(spot) > 1
        or spot == first
        or (spot.kind is Kind.BLOCK and spot.name in entered)
    )
    around = Context(elsewhere=frozenset(places), labels=frozenset(places))
    cases = tuple(
        # each with a writer of its own: here nothing is ever tried twice
        Case(label=spot.name, body=Writer(found, steps).body(spot, around))
        for spot in places
    )
    return (Dispatch(start=first.name, cases=cases, entries=entries),)
