"""The comparison of two apps, a line for each aspect."""

from __future__ import annotations

from collections.abc import Iterable

from plutoc.diff.blocks import blocks, settings
from plutoc.diff.both import Both, side_by_side
from plutoc.diff.branches import branches, gates, limits, order
from plutoc.diff.declared import app, categories, fields, hooks
from plutoc.diff.events import events
from plutoc.diff.journeys import gained, journeys, reroutes, stops, without_swaps
from plutoc.diff.messages.blocks import arranged_otherwise
from plutoc.diff.model import Change, Difference, Importance, Version
from plutoc.diff.own_fields import own_fields
from plutoc.diff.results import results
from plutoc.diff.warned import warned


def compare(old: Version, new: Version) -> Difference:
    """Return what changed in meaning, most important first."""
    both = side_by_side(old, new)
    moved, swapped = without_swaps(both, reroutes(both))
    told = [
        *limits(both),
        *gates(both),
        *swapped,
        *journeys(both, moved),
        *branches(both, moved),
        *gained(both),
        *settings(both),
        *stops(both),
        *app(both),
        *events(both),
        *hooks(both),
        *categories(both),
        *fields(both),
        *own_fields(both),
        *results(both),
        *order(both),
    ]
    told += warned(both, told)
    told += blocks(both, told)
    if not told and _arrows_differ(both):
        told.append(arranged_otherwise())
    return Difference(old=both.old.graph.source, new=both.new.graph.source, changes=_in_order(told))


def _in_order(told: Iterable[Change]) -> tuple[Change, ...]:
    """Sort by importance; within it, in the order in which the aspects stand above."""
    rank = {importance: place for place, importance in enumerate(Importance)}
    return tuple(sorted(dict.fromkeys(told), key=lambda change: rank[change.importance]))


def _arrows_differ(both: Both) -> bool:
    """Return whether missions take other arrows, gates included."""
    before = {
        (both.old.called([name])[0], status): both.old.known(targets)
        for (name, status), targets in both.old.routes.items()
    }
    after = {leaving: both.new.known(targets) for leaving, targets in both.new.routes.items()}
    return before != after
