"""Plans for tests."""

from __future__ import annotations

from plutoc.plan.build import build
from plutoc.plan.model import Plan
from plutoc.plan.optimise import stages
from tests.check.graphs import checked


def after(name: str, text: str) -> Plan:
    """Return the plan of a graph as it is after the pass of this name."""
    return dict(stages(build(checked(text))))[name]


def structured(text: str) -> Plan:
    """Return the plan of a graph before its steps change, without needless questions."""
    return after("decided", text)
