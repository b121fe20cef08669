"""What a graph may do while no trip flies: hooks, forks of them, retries, judges, and mazes."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from random import Random

from plutoc_runtime.domain.status import WORST_FIRST
from tests.kit.graphs.drawing import C, Drawing, Ends, F, S, Statuses, U, ordered

WIDTHS = (2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 7)
"""Of forks."""
RETRIES = ("", "max_attempts: 0", "max_attempts: 1", "max_attempts: 2", "max_attempts: 3")


def aside(drawing: Drawing, ends: Ends) -> Ends:
    """Draw a hook, or a fork of several, that leaves the statuses as they are."""
    if drawing.strange and drawing.chance(0.5):
        return drawing.into(ends, _strange(drawing))
    if drawing.full or drawing.chance(0.6):
        return drawing.into(ends, drawing.modifier("mark"))
    if len(ends) > 1:
        ends = drawing.into(ends, drawing.modifier("meet"))
    branches: list[Ends] = []
    for _ in range(drawing.rng.choice(WIDTHS)):
        branch = drawing.into(ends, drawing.modifier("do"))
        if drawing.chance(0.2):
            branch = drawing.into(branch, drawing.modifier("then"))
        elif drawing.chance(0.15):
            branch = aside(drawing, branch)
        elif drawing.chance(0.25):
            branch = retried(drawing, branch)
        branches.append(branch)
    if drawing.chance(0.2):
        branches.insert(drawing.rng.randint(0, len(branches)), dict(ends))
    return closed(drawing, branches)


def closed(drawing: Drawing, branches: Sequence[Ends], first: float = 0.6) -> Ends:
    """Draw the gate at which these branches close."""
    came = [ordered(s for statuses in ends.values() for s in statuses) for ends in branches]
    if drawing.chance(first):
        passes = ordered(status for statuses in came for status in statuses)
        gate = drawing.block("first", "GateFIFO", passes)
    else:
        passes = ordered(min(each, key=WORST_FIRST.index) for each in product(*came))
        gate = drawing.block("all", "GateFunnel", passes)
    for ends in branches:
        drawing.lead(ends, gate)
    return {gate: passes}


def _strange(drawing: Drawing) -> str:
    if drawing.chance(0.5):
        return drawing.block("tell", "others.Tell", ())
    given = [f"seconds: {drawing.seconds()}", "deep: yes", "deep: no"]
    written = ", ".join(dict.fromkeys(drawing.rng.choices(given[:2], k=2)))
    return drawing.block("nap", "others.Nap", (), written if drawing.chance(0.7) else given[2])


def retried(drawing: Drawing, ends: Ends) -> Ends:
    """Draw a block that puts a failed trip back, or leaves it out."""
    if not _any(ends, F):
        return ends
    if drawing.happens(0.2):
        skip = drawing.block("skip", "TripSkipper", (S, C))
        return {**drawing.lead(ends, skip, (F,)), skip: (S, C)}
    written = drawing.rng.choice(RETRIES)
    emits = (S,) if written.endswith(" 0") else (S, F)
    retry = drawing.block("retry", "PriorityManager", emits, written)
    return {**drawing.lead(ends, retry, (F,)), retry: emits}


def beside(drawing: Drawing, ends: Ends) -> Ends:
    """Draw a fork of failed missions of which a branch is only the arrow to the gate."""
    failed: Ends = {block: (F,) for block, statuses in ends.items() if F in statuses}
    if not failed:
        return ends
    kept = {block: tuple(s for s in each if s is not F) for block, each in ends.items()}
    mended = retried(drawing, dict(failed))
    if drawing.chance(0.4):
        mended = drawing.into(dict(failed), drawing.modifier("mend", (S, F)))
    branches = [mended, dict(failed)] if drawing.chance(0.5) else [dict(failed), mended]
    return {block: each for block, each in kept.items() if each} | closed(drawing, branches, 0.3)


def judged(drawing: Drawing, ends: Ends, kinds: Sequence[str] | None = None) -> Ends:
    """Draw one or both of the blocks that look at a finished mission."""
    if not _any(ends, C):
        return ends
    both = ["evaluator", "repeater"] if drawing.chance(0.8) else ["repeater", "evaluator"]
    for kind in kinds or drawing.rng.choice((both, both[:1], both[1:])):
        if kind == "evaluator":
            hook, given = _evaluator(drawing)
            name = drawing.block("judge", "MissionEvaluator", (S, C, F), f"hook: {hook}{given}")
        else:
            name = drawing.block("again", "MissionRepeater", (S, C))
        ends = {**drawing.lead(ends, name, (C,)), name: drawing.emits[name]}
    return ends


def _evaluator(drawing: Drawing) -> tuple[str, str]:
    """Declare an evaluator, and return it with what its block gives to it."""
    luck = Random(f"{len(drawing.words)}/{len(drawing.blocks)}")
    if drawing.plain or luck.random() < 0.5:
        return drawing.hook("evaluator", "judge"), ""
    hook = drawing.hook("evaluator", "judge", "(least: int = 2, share: percent = 20 %)")
    return hook, luck.choice(("", ", least: 3", ", least: 3, share: 40 %"))


def tangle(drawing: Drawing, ends: Ends) -> Ends:
    """Draw hooks that lead to each other as they like: such a maze has no structure."""
    statuses = ordered(s for each in ends.values() for s in each)
    said: tuple[Statuses, ...] = ((S, F), (S, C, F), (S, F), (C, F))
    if U in statuses:
        said = ((U, S), (U, S, F), (S, F))
    left = drawing.rng.choice((1, 2, 3, 3, 5))
    names = [drawing.modifier("maze", drawing.rng.choice(said))]

    def somewhere() -> str:
        nonlocal left
        if left and drawing.chance(0.5):
            left -= 1
            names.append(drawing.modifier("maze", drawing.rng.choice(said)))
            return names[-1]
        return drawing.rng.choice(names)

    for block, found in ends.items():
        parts = [found] if len(found) < 2 or drawing.chance(0.5) else [found[:1], found[1:]]
        for part in parts:
            drawing.lead({block: part}, somewhere() if len(names) > 1 else names[0])
    loose: Ends = {}
    for name in names:  # it grows on the way
        for status in drawing.emits[name]:
            if drawing.chance(0.65):
                drawing.lead({name: (status,)}, somewhere())
            else:
                loose[name] = (*loose.get(name, ()), status)
    return loose


def _any(ends: Ends, status: object) -> bool:
    return any(status in statuses for statuses in ends.values())
