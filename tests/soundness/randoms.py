"""Small random apps for the oracle: most could be flown, and then they are edited.

Of arrows drawn blindly nearly none could, and nothing would be learnt from them.
"""

from __future__ import annotations

from dataclasses import replace
from random import Random

from tests.kit.graphs.graph import random_source
from tests.kit.graphs.loops import looping_source
from tests.soundness.app import App, Block, read
from tests.soundness.mutants import mutants

SMALL = (4, 6, 8)
"""Blocks, about: an oracle that flies every way has to come to an end."""


def random_app(rng: Random) -> App:
    """Return an app, edited up to three times."""
    # a bound of one is left out: that its retry never retries is beyond what is checked
    text = random_source(rng, SMALL, strange=0.0, plain=True).replace(
        "max_attempts: 1", "max_attempts: 2"
    )
    app = read(text)
    for _ in range(rng.choice((0, 0, 1, 1, 2, 3))):
        app = _edited(app, rng)
    return app


def looping_app(rng: Random) -> App:
    """Return an app full of loops; now and then an arrow of it is not as it was drawn."""
    app = read(looping_source(rng))
    return _edited(app, rng) if rng.random() < 0.1 else app


def event_app(rng: Random) -> App:
    """Return an app in which events happen, edited up to twice."""
    app = _with_events(random_app(rng), rng)
    for _ in range(rng.choice((0, 0, 0, 1, 2))):
        app = _edited(app, rng)
    return app


def _with_events(app: App, rng: Random) -> App:
    """Return an app whose limits are events now and then, and whose missions are made of one, too."""
    blocks = tuple(_reacting(block, rng) for block in app.blocks)
    rest = ("event smoke", *app.rest)
    arrows = app.arrows
    makers = {block.name for block in blocks if block.kind == "MissionCreator"}
    begun = [arrow for arrow in arrows if arrow.source in makers]
    if begun and rng.random() < 0.7:
        rest = (*rest, "creator look_after")
        written = "(hook: look_after)"
        check = replace(blocks[0], name="check", kind="MissionCreator", written=written, emits=())
        blocks = (*blocks, replace(check, hook="look_after", event=""))
        targets = [block.name for block in blocks if block.kind in ("DroneAllocator", "Clock")]
        straight = replace(begun[0], source="check", guard=(), otherwise=False)
        if targets and rng.random() < 0.4:
            straight = replace(straight, target=rng.choice(targets))
        arrows = (*arrows, replace(straight, source="smoke", target="check"), straight)
    return replace(app, rest=rest, blocks=blocks, arrows=arrows)


def _reacting(block: Block, rng: Random) -> Block:
    if block.kind in ("TimerMonitor", "GapMonitor") and rng.random() < 0.6:
        event = rng.choice(("smoke", "late", "lost"))
        written = f"(event: {event}{rng.choice(('', ', of: any'))})"
        return replace(block, kind="EventMonitor", written=written, event=event)
    if block.kind == "PriorityManager" and rng.random() < 0.4:
        return replace(block, kind="TripSkipper", written="", limit=3)
    return block


def _edited(app: App, rng: Random) -> App:
    edits = list(mutants(app))
    edit = rng.choice(sorted({mutant.edit for mutant in edits}))
    return rng.choice([mutant.app for mutant in edits if mutant.edit == edit])
