"""Loops that nothing leaves."""

from __future__ import annotations

from plutoc.check.components import components
from plutoc.check.flow import Flow, Place

Round = tuple[Place, ...]


def rounds(flow: Flow) -> tuple[Round, ...]:
    """Return the loops that are never left, each as places in the order of discovery.

    A way comes to its end where nothing follows, or where some status is left without an edge,
    even if that is a mistake of its own.
    """
    before: dict[Place, list[Place]] = {place: [] for place in flow.places}
    for place, targets in flow.after.items():
        for target in targets:
            before[target].append(place)
    ending = [place for place, targets in flow.after.items() if not targets]
    ending.extend(place for place, _ in flow.loose)
    hopeful = set(ending)
    for place in ending:
        fresh = [p for p in before[place] if p not in hopeful]
        hopeful.update(fresh)
        ending.extend(fresh)
    lost = {p: tuple(targets) for p, targets in flow.after.items() if p not in hopeful}
    # the last loop on every way: what leads there is not worth a message of its own
    return tuple(
        part
        for part in components(lost)
        if set(part).issuperset(target for place in part for target in lost[place])
    )
