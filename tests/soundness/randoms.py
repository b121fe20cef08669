"""Small random apps for the oracle: most could be flown, and then they are edited.

Of arrows drawn blindly nearly none could, and nothing would be learnt from them.
"""

from __future__ import annotations

from random import Random

from tests.kit.graphs.graph import random_source
from tests.kit.graphs.loops import looping_source
from tests.soundness.app import App, read
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


def _edited(app: App, rng: Random) -> App:
    edits = list(mutants(app))
    edit = rng.choice(sorted({mutant.edit for mutant in edits}))
    return rng.choice([mutant.app for mutant in edits if mutant.edit == edit])
