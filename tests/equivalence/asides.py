"""What a graph may do while no trip flies: hooks, forks of them, retries, judges, and mazes."""

from __future__ import annotations

from collections.abc import Sequence

from tests.equivalence.drawing import C, Drawing, Ends, F, S, Statuses, U, ordered

RETRIES = ("", "max_attempts: 0", "max_attempts: 1", "max_attempts: 2", "max_attempts: 3")


def aside(drawing: Drawing, ends: Ends) -> Ends:
    """Draw a hook, or a fork of several, that leaves the statuses as they are."""
    if drawing.strange and drawing.chance(0.5):
        return drawing.into(ends, _strange(drawing))
    if drawing.full or drawing.chance(0.6):
        return drawing.into(ends, drawing.modifier("mark"))
    if len(ends) > 1:
        ends = drawing.into(ends, drawing.modifier("meet"))
    gate, kind = ("first", "GateFIFO") if drawing.chance(0.5) else ("all", "GateFunnel")
    branches: list[Ends] = []
    for _ in range(drawing.rng.choice((2, 2, 3))):
        branch = drawing.into(ends, drawing.modifier("do"))
        if drawing.chance(0.2):
            branch = drawing.into(branch, drawing.modifier("then"))
        elif drawing.chance(0.15):
            branch = aside(drawing, branch)
        branches.append(branch)
    if drawing.chance(0.15):
        branches.append(dict(ends))
    statuses = ordered(s for each in ends.values() for s in each)
    name = drawing.block(gate, kind, statuses)
    for branch in branches:
        drawing.lead(branch, name)
    return {name: statuses}


def _strange(drawing: Drawing) -> str:
    if drawing.chance(0.5):
        return drawing.block("tell", "others.Tell", ())
    given = [f"seconds: {drawing.seconds()}", "deep: yes", "deep: no"]
    written = ", ".join(dict.fromkeys(drawing.rng.choices(given[:2], k=2)))
    return drawing.block("nap", "others.Nap", (), written if drawing.chance(0.7) else given[2])


def retried(drawing: Drawing, ends: Ends) -> Ends:
    """Draw a block that puts a failed trip back."""
    if not _any(ends, F):
        return ends
    written = drawing.rng.choice(RETRIES)
    emits = (S,) if written.endswith(" 0") else (S, F)
    retry = drawing.block("retry", "PriorityManager", emits, written)
    return {**drawing.lead(ends, retry, (F,)), retry: emits}


def judged(drawing: Drawing, ends: Ends, kinds: Sequence[str] | None = None) -> Ends:
    """Draw one or both of the blocks that look at a finished mission."""
    if not _any(ends, C):
        return ends
    both = ["evaluator", "repeater"] if drawing.chance(0.8) else ["repeater", "evaluator"]
    for kind in kinds or drawing.rng.choice((both, both[:1], both[1:])):
        if kind == "evaluator":
            hook = drawing.hook("evaluator", "judge")
            name = drawing.block("judge", "MissionEvaluator", (S, C, F), f"hook: {hook}")
        else:
            name = drawing.block("again", "MissionRepeater", (S, C))
        ends = {**drawing.lead(ends, name, (C,)), name: drawing.emits[name]}
    return ends


def tangle(drawing: Drawing, ends: Ends) -> Ends:
    """Draw hooks that lead to each other as they like: such a maze has no structure."""
    statuses = ordered(s for each in ends.values() for s in each)
    said: tuple[Statuses, ...] = ((S, F), (S, C, F), (S, F), (C, F))
    if U in statuses:
        said = ((U, S), (U, S, F), (S, F))
    left = drawing.rng.choice((1, 2, 3))
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
            if drawing.chance(0.55):
                drawing.lead({name: (status,)}, somewhere())
            else:
                loose[name] = (*loose.get(name, ()), status)
    return loose


def _any(ends: Ends, status: object) -> bool:
    return any(status in statuses for statuses in ends.values())
