"""Accepted apps end when they are flown; `python -m tests.soundness --loops 5000 --fly` flies many."""

from __future__ import annotations

from random import Random

from plutoc.check.model import Checked
from plutoc.compile import analyse
from plutoc.diagnostic import Rejected
from plutoc.source import Source
from tests.soundness.app import App
from tests.soundness.endings import End, endings
from tests.soundness.randoms import looping_app


def accepted(app: App) -> Checked | None:
    try:
        return analyse(Source(path="app.pluto", text=app.text))[0]
    except Rejected:
        return None


def flown(seeds: range, *, real: bool) -> list[End]:
    """Fly those of some random apps that are accepted."""
    ends: list[End] = []
    for seed in seeds:
        app = looping_app(Random(f"loops/{seed}"))
        checked = accepted(app)
        if checked is not None:
            ends += endings(checked, seed, real=real)
            assert End.HANGS not in ends, (seed, app.text)
    return ends


def test_what_is_accepted_ends_with_hooks_that_never_change_their_mind() -> None:
    ends = flown(range(60), real=False)
    assert ends.count(End.COMPLETED) > 25
    assert ends.count(End.FAILED) > 3


def test_it_ends_by_the_driver_of_real_flights_as_well() -> None:
    assert len(flown(range(10), real=True)) > 3
