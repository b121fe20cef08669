"""The ways that findings print: each is a real run, and none is shorter."""

from __future__ import annotations

from random import Random

import pytest

from plutoc.compile import analyse
from plutoc.diagnostic import Rejected, Severity
from plutoc.source import Source
from tests.soundness.app import App
from tests.soundness.mutants import mutants
from tests.soundness.randoms import random_app
from tests.soundness.thesis import thesis_graphs
from tests.soundness.ways import hops_to_trouble, ways_in

CODES = ("P2009", "P2011", "P2012", "P2016", "P2017", "P2021", "P2022")
"""Those of what happens to a mission at a place of its own."""
GRAPHS = thesis_graphs()
MOST = 3
"""Apps of a graph that are looked at."""


def alone(app: App) -> str | None:
    """Return the help of the only error, if there is one, and a way shows it."""
    try:
        analyse(Source(path="app.pluto", text=app.text))
    except Rejected as rejected:
        errors = [d for d in rejected.diagnostics if d.severity is Severity.ERROR]
        if len(errors) == 1 and errors[0].code in CODES:
            return errors[0].help
    return None


def check_way(app: App, help: str) -> None:
    (way,) = ways_in(help)
    where = way[-1][0]
    assert hops_to_trouble(app, where, way) == len(way), ("no run goes", way, app.text)
    assert hops_to_trouble(app, where) == len(way), ("not the shortest", way, app.text)


@pytest.mark.parametrize("name", GRAPHS)
def test_printed_way_is_a_shortest_run(name: str) -> None:
    found = list(mutants(GRAPHS[name]))
    Random(name).shuffle(found)
    looked_at = 0
    for mutant in found:
        help = alone(mutant.app)
        if help is not None and looked_at < MOST:
            check_way(mutant.app, help)
            looked_at += 1
    assert looked_at == MOST


def test_printed_way_of_random_apps_is_a_shortest_run() -> None:
    looked_at = 0
    for seed in range(60):
        app = random_app(Random(seed))
        help = alone(app)
        if help is not None:
            check_way(app, help)
            looked_at += 1
    assert looked_at > 3
