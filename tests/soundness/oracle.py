"""Says of an app whether its missions can be flown, by flying them all.

An interpreter and no proof: from one to three trips, every outcome of each, every verdict, every
order in which clones move. It knows what a graph means and nothing of how the compiler checks it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from tests.soundness.app import App, is_rest
from tests.soundness.explore import Explorer, Seen, first_blocks, unlike_bounds
from tests.soundness.kinds import NEED_A_TRIP
from tests.soundness.state import Verdict
from tests.soundness.walk import Run


@dataclass(frozen=True, slots=True, kw_only=True)
class Judgement:
    """What all runs of an app say of it."""

    runs: dict[Verdict, Run]
    """What goes wrong, with a shortest run that shows it."""
    faults: tuple[str, ...]
    """What no single run shows, but all of them together."""
    doubtful: bool
    """It depends on how far a modifier's hook may change a mission's trips, or on which of several
    unlike bounds is reached first; or there were too many runs."""
    states: int

    @property
    def sound(self) -> bool:
        return not self.runs and not self.faults


def judge(app: App) -> Judgement:
    """Fly an app's missions in every way that they can go."""
    first = first_blocks(app)
    if not first:
        return Judgement(runs={}, faults=("missions begin nowhere",), doubtful=False, states=0)
    strict = _judged(app, first, strict=True)
    if unlike_bounds(app) or any(block.emits for block in app.blocks):
        loose = _judged(app, first, strict=False)
        doubtful = strict.doubtful or loose.doubtful or strict.sound != loose.sound
        return replace(strict, doubtful=doubtful)
    return strict


def _judged(app: App, first: list[str], *, strict: bool) -> Judgement:
    seen = _seen(app, first, strict=strict)
    faults = (
        ()
        if seen.cut
        else (
            *_dead(app, seen, first),
            *_spent(app, seen),
            *_scattered(seen),
            *_unwatched(seen),
            *_waited_twice(seen),
            *_along_nothing(app),
        )
    )
    return Judgement(
        runs=seen.wrong,
        faults=faults,
        doubtful=seen.cut and not seen.wrong,
        states=seen.states,
    )


def _seen(app: App, first: list[str], *, strict: bool) -> Seen:
    seen = Explorer(app, strict=strict, patient=False).explore(first)
    if not seen.wrong and any(block.kind == "GateFIFO" for block in app.blocks):
        patient = Explorer(app, strict=strict, patient=True).explore(first)
        for verdict in (Verdict.DEADLOCKED, Verdict.ENDLESS):
            if verdict in patient.wrong:
                seen.wrong.setdefault(Verdict.UNCLOSED, patient.wrong[verdict])
    return seen


def _dead(app: App, seen: Seen, first: list[str]) -> tuple[str, ...]:
    """Return the arrows that no run takes, and the blocks that no run comes to."""
    taken = {arrow for arrow, _ in seen.taken}
    come = {arrow.target for arrow in taken} | {*first}
    # an arrow that takes what is left is worth a warning only, when nothing is
    dead = [
        a for a in app.arrows if a not in taken and a.source not in app.sources and not is_rest(a)
    ]
    arrows = [f"nothing takes {arrow}" for arrow in dead]
    blocks = [f"nothing comes to {b.name}" for b in app.blocks if b.name not in come]
    return (*blocks, *arrows)


def _spent(app: App, seen: Seen) -> tuple[str, ...]:
    """Return the arrows along which missions come only to end, as they have no trip left."""
    kind = {block.name: block.kind for block in app.blocks}
    return tuple(
        f"what takes {arrow} {status} has no trip left"
        for arrow, status in sorted(seen.taken - seen.with_trips, key=str)
        if kind.get(arrow.target) in NEED_A_TRIP
    )


def _scattered(seen: Seen) -> tuple[str, ...]:
    """Return the forks that close now at one gate and now at another."""
    return tuple(
        f"{block} {status} closes at {', '.join(sorted(gates))}"
        for (block, status), gates in sorted(seen.closed.items())
        if len(gates) > 1
    )


def _unwatched(seen: Seen) -> tuple[str, ...]:
    """Return the limits that somewhere have no TripMonitor beside them."""
    alone = {block for block, _ in seen.limited - seen.beside}
    return tuple(f"{block} has no TripMonitor beside it" for block in sorted(alone))


def _waited_twice(seen: Seen) -> tuple[str, ...]:
    """Return the events for which two blocks wait in one fork."""
    return tuple(
        f"in the fork of {block} {status} both {one} and {other} wait for {event}"
        for (block, status), waits in sorted(seen.waited.items())
        for event, one in sorted(waits)
        for again, other in sorted(waits)
        if event == again and one < other
    )


def _along_nothing(app: App) -> tuple[str, ...]:
    """Return the actions on the way of an app in which nothing flies."""
    if any(block.kind == "TripLauncher" for block in app.blocks):
        return ()
    return tuple(line for line in app.rest if re.fullmatch(r"action .*\balong\b.*", line))
