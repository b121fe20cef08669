"""For a chart that has no structure: a case for each spot that is jumped to.

What one arrow alone leads to is written where it is led to, so chains and branches stay together.
"""

from __future__ import annotations

from collections.abc import Mapping

from plutoc.plan.chart import Spot
from plutoc.plan.model import Body, Case, Dispatch
from plutoc.plan.shape import Shape
from plutoc.plan.structure import Around, Writer


def dispatch(found: Shape, steps: Mapping[Spot, Body]) -> Body:
    """Return a chart as one dispatch over the spots that several arrows lead to."""
    places = tuple(s for s in found.order if s in found.shared or s == found.chart.entry)
    around = Around(elsewhere=frozenset(places), labels=frozenset(places))
    cases = tuple(
        # each with a writer of its own: here nothing is ever tried twice
        Case(label=spot.name, body=Writer(found, steps).body(spot, around))
        for spot in places
    )
    return (Dispatch(start=found.chart.entry.name, cases=cases),)
