"""Blocks of other packages: what is known of them by their properties, and no more, is used."""

from __future__ import annotations

from dataclasses import replace

import pytest

from plutoc.block import Block, Param
from plutoc.plan.optimise import optimised
from plutoc.plan.show import show
from plutoc_runtime.domain.quantities import Type
from tests.compiler.check.graphs import KINDS
from tests.compiler.plan.plans import after

ASKING = (Param(name="volume", type=Type.FLOAT, doc="How loud.", default=1.0),)
TIMER, MONITOR, FIRST = (KINDS[name] for name in ("TimerMonitor", "TripMonitor", "GateFIFO"))
ALL = KINDS["GateFunnel"]


RACE = """
    create = MissionCreator
    allocate = DroneAllocator
    launch = TripLauncher
    watch = TripMonitor
    timer = TimerMonitor
    first = GateFIFO
    start -> create -> allocate -> launch -> [watch, timer] -> first
    first -> allocate when STANDBY
    first -> end"""
ARROW_TO_A_GATE = """
    create = MissionCreator
    allocate = DroneAllocator
    launch = TripLauncher
    watch = TripMonitor
    tell = MissionModifier
    note = MissionModifier
    all = GateFunnel
    start -> create -> allocate -> launch -> watch
    watch -> tell when STANDBY
    watch -> end
    tell -> note -> all
    tell -> all
    all -> allocate"""


def plan(monkeypatch: pytest.MonkeyPatch, kind: str, strange: Block, text: str = RACE) -> str:
    """Return the plan of an app that has a stranger in the place of a block."""
    monkeypatch.setitem(KINDS, "Strange", replace(strange, name="Strange"))
    return show(optimised(after("built", text.replace(f"= {kind}", "= Strange"))))


@pytest.mark.parametrize(
    ("kind", "strange"),
    [
        ("TimerMonitor", replace(TIMER, limit=None)),
        ("TripMonitor", replace(MONITOR, params=ASKING)),
        ("TripMonitor", replace(MONITOR, named=True)),
        ("GateFIFO", replace(FIRST, params=ASKING)),
    ],
    ids=["a limit it does not tell", "a watcher that asks", "one with a name", "a gate that asks"],
)
def test_who_may_do_more_is_called(
    monkeypatch: pytest.MonkeyPatch, kind: str, strange: Block
) -> None:
    """A wait could not stand for it."""
    assert "join launch -> first" in plan(monkeypatch, kind, strange)


@pytest.mark.parametrize(
    ("kind", "strange"),
    [("TimerMonitor", TIMER), ("TripMonitor", MONITOR), ("GateFIFO", FIRST)],
    ids=["a limit", "a watcher", "a gate"],
)
def test_who_is_like_one_of_ours_is_fused(
    monkeypatch: pytest.MonkeyPatch, kind: str, strange: Block
) -> None:
    """Names do not count."""
    assert "watch launch -> [watch, timer] -> first" in plan(monkeypatch, kind, strange)


def test_a_gate_that_asks_may_count_the_clones(monkeypatch: pytest.MonkeyPatch) -> None:
    """Then one goes along an arrow, too, though it brings nothing new to a gate like ours."""
    spared = "no branch for tell -> all"
    assert spared in plan(monkeypatch, "GateFunnel", ALL, ARROW_TO_A_GATE)
    asking = replace(ALL, params=ASKING)
    assert spared not in plan(monkeypatch, "GateFunnel", asking, ARROW_TO_A_GATE)
