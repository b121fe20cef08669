"""Blocks of other packages are as good as ours: what is said comes from their properties.

`strangers.txt` has edits of the app below, each a text and what stands in its place, and all that is said of them.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from plutoc.block import Block, Choice, HookKind, HookParam, Param, emits, same
from plutoc.check.run import check
from plutoc.diff.model import Version
from plutoc.diff.run import compare
from plutoc.graph.resolve import resolve
from plutoc.registry import STD, Blocks, blocks_of
from plutoc.source import Source
from plutoc.syntax.parse import parse
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status
from tests.compiler.diff.pairs import edited
from tests.kit.sections import Section, params
from tests.kit.sections import compare as compare_case


def step() -> None:
    """Do nothing: no test here runs a block."""


FIRST = same(Status.UNEXECUTED, Status.STANDBY)
NAP = Block(
    name="Nap",
    doc="Sleeps.",
    step=step,
    transitions=FIRST,
    params=(Param(name="depth", type=Type.LENGTH, doc="How deep. Or not.", default=1.0),),
    holds=True,
)
PATIENCE = Block(
    name="Patience",
    doc="Loses it.",
    step=step,
    transitions={Status.RUNNING: emits(Status.STANDBY, Status.COMPLETED, Status.FAILED)},
    params=(
        Param(name="within", type=Type.TIME, doc="How long.", default=60.0),
        Param(name="loud", type=Type.BOOL, doc="With a noise.", default=False),
    ),
    watches=True,
    limits=True,
)
MEND = Block(
    name="Mend",
    doc="Puts a trip back.",
    step=step,
    transitions={Status.FAILED: emits(Status.STANDBY)},
    retries=True,
)
TURN = Block(
    name="Turn",
    doc="Turns.",
    step=step,
    transitions=FIRST,
    params=(
        Choice(name="way", options={"left": step, "right": step}, default="left", doc="Where to."),
        HookParam(name="hook", kind=HookKind.MODIFIER, doc="Which.", required=False),
    ),
)
JUDGE = Block(
    name="Judge",
    doc="Judges by itself.",
    step=step,
    transitions={Status.COMPLETED: emits(Status.COMPLETED, Status.FAILED)},
    evaluates=True,
)
MINE = {block.name: block for block in (NAP, PATIENCE, MEND, TURN, JUDGE)}
YOURS = {NAP.name: NAP}
BLOCKS = Blocks(
    packages=(STD, "mine", "yours"),
    of=lambda name: {"mine": MINE, "yours": YOURS}.get(name) or blocks_of(STD),
)
APP = """pluto 1
use mine
use yours
app demo {
  modifier look
  create = MissionCreator
  rest = mine.Nap
  other = yours.Nap
  turn = mine.Turn
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  calm = mine.Patience
  first = GateFIFO
  mend = mine.Mend
  judge = mine.Judge
  start -> create -> rest -> other -> turn -> allocate -> launch -> [watch, calm] -> first
  first -> allocate when STANDBY
  first -> mend -> allocate
  first -> judge -> end
}
"""


def version(text: str) -> Version:
    """Check an app of these blocks."""
    graph, warnings = resolve(parse(Source("demo.pluto", text)), BLOCKS)
    checked, found = check(graph)
    return Version(checked=checked, warnings=warnings + found)


@pytest.mark.parametrize("case", params(Path(__file__).with_name("strangers.txt")))
def test_what_is_said_comes_from_properties(case: Section, update: bool) -> None:
    """There, and on the way back."""
    edits = [(old, new) for old, new in map(json.loads, case.given.splitlines())]
    old, new = version(APP), version(edited(APP, *edits))
    there, back = compare(old, new).changes, compare(new, old).changes
    lines = ["-- there", *(change.sentence for change in there)]
    lines += ["-- back", *(change.sentence for change in back)]
    compare_case(case, "\n".join(lines), update)
