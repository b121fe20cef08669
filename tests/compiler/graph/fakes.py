"""Blocks of our own making, so that these tests know what they depend on."""

from __future__ import annotations

from plutoc.block import ANY_SAME, Block, Choice, HookKind, HookParam, Narrowed, Param, emits
from plutoc.diagnostic import Diagnostic
from plutoc.graph.model import Graph
from plutoc.graph.resolve import resolve
from plutoc.registry import Blocks, RegistryError
from plutoc.source import Source
from plutoc.syntax.parse import parse
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status


def step() -> None:
    """Do nothing: no test here runs a block."""


PASS = Block(name="Pass", doc="Hands everything on.", step=step, transitions=ANY_SAME)
MAKE = Block(
    name="Make",
    doc="Begins.",
    step=step,
    transitions={Status.UNEXECUTED: emits(Status.UNEXECUTED)},
    creates=True,
)
WORK = Block(
    name="Work",
    doc="Works, and takes what failed only by a guard.",
    step=step,
    transitions={Status.UNEXECUTED: emits(Status.COMPLETED, Status.FAILED)},
    guarded={Status.FAILED: emits(Status.STANDBY)},
    params=(
        Param(name="wait", type=Type.TIME, doc="How long.", default=60.0, least=0),
        Param(name="tries", type=Type.INT, doc="How often.", default=3, least=0),
        Param(name="factor", type=Type.FLOAT, doc="By how much."),
        Param(name="loud", type=Type.BOOL, doc="Audible?", default=False),
        Param(name="label", type=Type.TEXT, doc="Any text.", default=""),
        Param(name="level", type=Type.PERCENT, doc="How much.", default=0.5),
        Param(name="heat", type=Type.TEMPERATURE, doc="How hot."),
        Choice(
            name="way",
            options={"left": step, "right": step},
            default="left",
            doc="Where to.",
            hook=HookKind.POLICY,
        ),
    ),
    narrowed=(Narrowed(param="tries", value=0, emits=emits(Status.COMPLETED)),),
)
CALL = Block(
    name="Call",
    doc="Calls a modifier.",
    step=step,
    transitions=ANY_SAME,
    params=(HookParam(name="hook", kind=HookKind.MODIFIER, doc="Which.", passes=True),),
    emits_by_hook=True,
)
JUDGE = Block(
    name="Judge",
    doc="Calls an evaluator, if there is one.",
    step=step,
    transitions=ANY_SAME,
    params=(
        HookParam(name="hook", kind=HookKind.EVALUATOR, doc="Which.", required=False),
        Param(name="strictness", type=Type.INT, doc="How strict.", required=True),
    ),
)
ELSEWHERE = Block(name="Scan", doc="Of a package.", step=step, transitions=ANY_SAME)

PACKAGES = {
    "std": {block.name: block for block in (PASS, MAKE, WORK, CALL, JUDGE)},
    "survey": {"Scan": ELSEWHERE},
}


def _of(package: str) -> dict[str, Block]:
    if package == "broken":
        raise RegistryError("its blocks cannot be loaded: ImportError: no module named gone")
    return PACKAGES[package]


BLOCKS = Blocks(packages=("std", "survey", "broken"), of=_of)


def graph_of(statements: str, uses: str = "") -> tuple[Graph, tuple[Diagnostic, ...]]:
    """Resolve an app of these statements."""
    text = f"pluto 1\n{uses}\napp demo {{\n{statements}\n}}\n"
    return resolve(parse(Source("demo.pluto", text)), BLOCKS)


def graph(statements: str, uses: str = "") -> Graph:
    """Resolve an app that gives no warning."""
    resolved, warnings = graph_of(statements, uses)
    assert warnings == ()
    return resolved
