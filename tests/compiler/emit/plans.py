"""Plans for tests: an app's text, taken through the compiler as far as its files."""

from __future__ import annotations

from plutoc import registry
from plutoc.check.model import Checked
from plutoc.check.run import check
from plutoc.compile import planned
from plutoc.graph.resolve import resolve
from plutoc.plan.model import Plan
from plutoc.source import Source
from plutoc.syntax.parse import parse


def checked_of(text: str, blocks: registry.Blocks | None = None) -> Checked:
    """Return the checked graph of an app."""
    graph, _ = resolve(parse(Source("app.pluto", text)), blocks or registry.blocks())
    return check(graph)[0]


def plan_of(text: str, blocks: registry.Blocks | None = None, *, optimise: bool = True) -> Plan:
    """Return the plan of an app."""
    return planned(checked_of(text, blocks), optimise=optimise)
