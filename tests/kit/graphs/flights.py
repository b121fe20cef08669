"""What a graph may do while a trip flies: monitors, forks of them, hooks beside them, forks in forks."""

from __future__ import annotations

from tests.kit.graphs.asides import aside, closed, judged, retried, tangle
from tests.kit.graphs.drawing import C, Drawing, Ends, F, R, S, Statuses, ordered

OUTCOMES = (S, C, F)
SAID: tuple[Statuses, ...] = (OUTCOMES, OUTCOMES, (F,), (R, F), (), ())
"""What a hook beside a monitor declares."""
WAITED_FOR = tuple(
    f"event: {name}{of}" for name in ("smoke", "seen", "late", "lost") for of in ("", ", of: any")
)
DEEPEST = 3
USUAL = (("watch", "timer"), ("watch", "gap"), ("watch", "gap", "timer"), ("timer", "watch", "gap"))


def flight(drawing: Drawing, ends: Ends, depth: int = 0) -> Ends:
    """Draw what watches a trip that flies; its outcome is known at the end."""
    while any(R in statuses for statuses in ends.values()):
        flying: Ends = {block: (R,) for block, statuses in ends.items() if R in statuses}
        over = {block: tuple(s for s in statuses if s is not R) for block, statuses in ends.items()}
        ends = {block: statuses for block, statuses in over.items() if statuses}
        watched = _watched(drawing, flying, depth)
        for block, statuses in watched.items():
            ends[block] = ordered((*ends.get(block, ()), *statuses))
        depth = max(depth, 2) if drawing.chance(0.7) else depth
    return ends


def _watched(drawing: Drawing, ends: Ends, depth: int) -> Ends:
    drawn = drawing.rng.random()
    if drawing.full or depth >= DEEPEST or drawn < (0.12 if depth == 0 else 0.45):
        return monitor(drawing, ends)
    if drawn < (0.9 if depth == 0 else 0.75):
        return fork(drawing, ends, depth)
    said = drawing.rng.choice(((), (), (R, F)))
    return drawing.into(ends, drawing.modifier("note", said))


def monitor(drawing: Drawing, ends: Ends) -> Ends:
    """Draw a block that ends with the trip's outcome."""
    kind = "TripMonitor"
    if drawing.strange and drawing.chance(0.4):
        kind = drawing.rng.choice(("others.Eye", "others.Witness"))
    written = "relief: 25 %" if kind == "TripMonitor" and drawing.happens(0.2) else ""
    return drawing.into(ends, drawing.block("watch", kind, OUTCOMES, written))


def limit(drawing: Drawing, ends: Ends, kind: str) -> Ends:
    """Draw a block that fails the trip at its limit, or breaks the flight off at an event."""
    if drawing.events is not None and drawing.happens(0.5):
        event = drawing.events.choice(WAITED_FOR)
        return drawing.into(ends, drawing.block("event", "EventMonitor", OUTCOMES, event))
    if drawing.strange and drawing.chance(0.5):
        kind = drawing.rng.choice(("others.Deadline", "others.Patience"))
    given = "within" if kind.startswith("others.") else "default"
    default = f"{given}: {drawing.seconds()}" if drawing.chance(0.5) else ""
    name = "timer" if kind == "TimerMonitor" else "gap"
    return drawing.into(ends, drawing.block(name, kind, OUTCOMES, default))


def fork(drawing: Drawing, ends: Ends, depth: int) -> Ends:
    """Draw a fork while a trip flies, and its gate."""
    rng = drawing.rng
    kinds = ["watch", *rng.choices(_BESIDE, k=rng.choice((1, 1, 1, 2, 2, 3)))]
    if drawing.chance(0.1):
        kinds[0] = "hook"
    if "watch" not in kinds:
        kinds = [kind for kind in kinds if kind not in _LIMITS]
    for kind in _LIMITS:
        while kinds.count(kind) > 1:
            kinds.remove(kind)
    while len(kinds) < 2:
        kinds.append("hook")
    if kinds.count("straight") > 1:
        kinds = ["straight", *(kind for kind in kinds if kind != "straight")]
    rng.shuffle(kinds)
    if drawing.chance(0.25):  # as it stands in the thesis, and as most people write it
        kinds = list(drawing.rng.choice(USUAL))
    branches = [_behind(drawing, _branch(drawing, ends, kind, depth)) for kind in kinds]
    return closed(drawing, branches)


_LIMITS = {"timer": "TimerMonitor", "gap": "GapMonitor"}
_BESIDE = ("timer", "timer", "timer", "gap", "gap", "hook", "hook", "nested", "chain", "straight")


def _branch(drawing: Drawing, ends: Ends, kind: str, depth: int) -> Ends:
    if kind == "straight":
        return dict(ends)
    if kind == "watch":
        return monitor(drawing, ends)
    if kind == "nested":
        inside = depth + 1 < DEEPEST and not drawing.full
        ends = drawing.into(ends, drawing.modifier("note")) if inside else ends
        return fork(drawing, ends, depth + 1) if inside else monitor(drawing, ends)
    if drawing.chance(0.2) and not drawing.full:
        ends = drawing.into(ends, drawing.modifier("first"))
    if kind in _LIMITS:
        return limit(drawing, ends, _LIMITS[kind])
    if kind == "chain" and not drawing.full:
        return flight(drawing, drawing.into(ends, drawing.modifier("note")), depth + 1)
    said = drawing.rng.choice(SAID)
    ends = drawing.into(ends, drawing.modifier("tell", said))
    if len(said) > 1 and said[0] is R and drawing.chance(0.3):
        (name,) = ends
        drawing.lead(ends, name, (R,))  # it asks again and again, until it has failed
        ends = {name: (F,)}
    return ends


def _behind(drawing: Drawing, ends: Ends) -> Ends:
    """Draw what comes between a monitor and its gate, if anything does."""
    drawn = drawing.rng.random()
    if drawing.full or drawn > 0.3 or any(R in statuses for statuses in ends.values()):
        return ends
    if drawn < 0.08:
        return retried(drawing, ends)
    if drawn < 0.16:
        return judged(drawing, ends)
    if drawn < 0.2:
        return tangle(drawing, ends)
    return aside(drawing, ends)
