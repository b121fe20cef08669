"""Plans for tests."""

from __future__ import annotations

from dataclasses import replace

from plutoc.check.model import Checked
from plutoc.plan.build import build
from plutoc.plan.model import Plan
from plutoc.plan.optimise import stages
from tests.compiler.check.graphs import BASIC, checked

_CLOCKS = [f"wait{n}" for n in range(50)]
CHAIN = "\n".join(
    [
        BASIC,
        *(f"{name} = Clock" for name in _CLOCKS),
        f"start -> create -> {' -> '.join(_CLOCKS)} -> allocate -> launch -> watch",
        "watch -> wait0 when STANDBY",
        "watch -> end",
    ]
)
"""More blocks where missions go on than are asked for one by one."""


def begun(text: str) -> Checked:
    """Return a graph in which missions go on nowhere: one that is interrupted begins anew."""
    return replace(checked(text), entries={})


def after(name: str, text: str) -> Plan:
    """Return the plan of a graph as it is after the pass of this name; it cannot be entered."""
    return dict(stages(build(begun(text))))[name]


def structured(text: str) -> Plan:
    """Return the plan of a graph before its steps change, without needless questions."""
    return after("decided", text)
