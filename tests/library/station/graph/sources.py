"""Apps to be drawn: the examples, and random ones that are sound."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from random import Random

from plutoc.check.model import Checked
from plutoc.compile import analyse
from plutoc.diagnostic import Rejected
from plutoc.source import Source
from tests.kit.graphs.graph import random_source
from tests.paths import ROOT

EXAMPLES = sorted(ROOT.glob("examples/*/app.pluto"))


def checked(text: str) -> Checked:
    """Return the checked graph of an app."""
    return analyse(Source("app.pluto", text))[0]


@cache
def examples() -> dict[str, Checked]:
    """Return the graph of each example, by its name."""
    return {path.parent.name: checked(path.read_text(encoding="utf-8")) for path in EXAMPLES}


def random_graphs(many: int) -> Iterator[Checked]:
    """Yield graphs, some of them large and strange."""
    seed = 0
    while many:
        seed += 1
        try:
            graph = checked(random_source(Random(f"drawn/{seed}")))
        except Rejected:
            continue
        many -= 1
        yield graph
