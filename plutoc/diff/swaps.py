"""Two steps that have changed places: told once, and not as three ways that lead elsewhere."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from plutoc.diff.both import Both
from plutoc.diff.journeys import Reroute, places
from plutoc.diff.model import Change
from plutoc.diff.words import routes as words
from plutoc_runtime.domain.status import Status

_Swaps = dict[tuple[str, str], dict[Status, Reroute]]
"""The step that came first and the one that comes first now, by their new names: for each status
the way out of the former."""


def without_swaps(
    both: Both, moved: Sequence[Reroute]
) -> tuple[tuple[Reroute, ...], tuple[Change, ...]]:
    """Return the ways that are not explained by steps that changed places, and what explains them.

    `x -> y` has become `y -> x`, and what came behind `y` comes behind `x` now.
    """
    swaps: _Swaps = {}
    for one in moved:
        for second, status in _swapped(both, one):
            swaps.setdefault((one.new.name, second), {})[status] = one
    told = tuple(
        _told(both, next(iter(ways.values())), second, tuple(ways))
        for (_, second), ways in swaps.items()
    )
    return tuple(_left(both, moved, swaps)), told


def _told(both: Both, one: Reroute, second: str, statuses: tuple[Status, ...]) -> Change:
    now = places(both.new, both.new.graph.node[second], statuses)
    return words.swapped(both, one, second, statuses, (places(both.old, one.old, statuses), now))


def _swapped(both: Both, one: Reroute) -> Iterator[tuple[str, Status]]:
    """Yield what has changed places with the block that this way leads out of."""
    if one.forks:
        return
    (second,), old_second = both.old.called(one.before), one.before[0]
    for status in one.statuses:
        back = both.new.destinations.get((second, status))
        behind = both.old.destinations.get((old_second, status), ())
        if back == (one.new.name,) and both.old.called(behind) == one.after:
            yield second, status


def _left(both: Both, moved: Sequence[Reroute], swaps: _Swaps) -> Iterator[Reroute]:
    for one in moved:
        before, name = both.old.called(one.before), one.new.name
        explained = {
            status
            for (first, second), ways in swaps.items()
            if name in (first, second) or (before == (first,) and one.after == (second,))
            for status in ways
        }
        statuses = tuple(status for status in one.statuses if status not in explained)
        if statuses:
            yield replace(one, statuses=statuses)
