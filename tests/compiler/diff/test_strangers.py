"""Blocks of other packages are as good as ours: what is said comes from their properties."""

from __future__ import annotations

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


def said(*edits: tuple[str, str]) -> list[str]:
    """Return what is said of the app and of an edited one."""
    changes = compare(version(APP), version(edited(APP, *edits))).changes
    return [change.sentence for change in changes if not change.kind.startswith("warning")]


def test_nothing_is_said_where_nothing_changed() -> None:
    """Other names of packages are none of the mission's."""
    assert said() == []
    assert said(("use mine\n", "use mine as ours\n"), ("= mine.", "= ours.")) == []


def test_a_parameter_is_told_with_what_it_is() -> None:
    """By the first sentence of its documentation."""
    assert said(("mine.Nap", "mine.Nap(depth: 30 cm)")) == [
        "`depth` of `rest` is now 30 cm; before, it was 1 m (how deep)"
    ]
    assert said(("mine.Patience", "mine.Patience(loud: yes)")) == [
        "`loud` of `calm` is now yes; before, it was no (with a noise)"
    ]


def test_a_limit_without_a_field_is_called_by_its_kind() -> None:
    """It has no other name."""
    alone = (("  calm = mine.Patience\n", ""), ("[watch, calm]", "[watch]"), (" -> first\n", "\n"))
    gate = (("  first = GateFIFO\n", ""), ("first ->", "watch ->"))
    assert "a trip's time (`Patience`) is no longer watched" in said(*alone, *gate)


def test_a_retry_that_has_no_bound_is_one_without_a_bound() -> None:
    """And where a failed mission ended it is told what it does now."""
    gone = (("  mend = mine.Mend\n", ""), ("  first -> mend -> allocate\n", ""))
    ends = ("  first -> judge -> end\n", "  first -> judge -> end\n  first -> end when FAILED\n")
    assert "a FAILED mission is no longer retried: it ends" in said(*gone, ends)
    changes = compare(version(edited(APP, *gone, ends)), version(APP)).changes
    assert "a FAILED mission is now retried without a bound; before, it ended" in [
        change.sentence for change in changes
    ]


def test_a_wait_that_no_field_describes_is_called_by_its_block() -> None:
    """So is a drone that is held meanwhile."""
    changes = compare(
        version(APP),
        version(
            edited(
                APP,
                ("rest -> other", "other"),
                ("allocate -> launch", "allocate -> rest -> launch"),
            )
        ),
    ).changes
    sentences = [change.sentence for change in changes]
    assert (
        "a drone is held during the wait at `rest`: missions come to `rest` with one allocated,"
        " which no other mission can use"
    ) in sentences
    assert "a new mission no longer waits at `rest`: it waits at `other`" in sentences


def test_a_choice_is_told_by_its_name() -> None:
    """And a hook that is optional may come and go."""
    assert said(("mine.Turn", "mine.Turn(way: right)")) == [
        "`way` of `turn` is now `right`; before, `left` (where to)"
    ]
    assert said(("mine.Turn", "mine.Turn(hook: look)")) == [
        "`turn` now calls `look`; before, it called none"
    ]


def test_a_block_of_another_package_is_another_block() -> None:
    """Though its kind has the same name."""
    assert said(("rest = mine.Nap", "rest = yours.Nap")) == [
        "`rest` is now a `yours.Nap`; before, a `mine.Nap`"
    ]


def test_one_that_judges_by_itself_judges() -> None:
    """No hook is named."""
    assert said(("first -> judge -> end", "first -> end"), ("  judge = mine.Judge\n", "")) == [
        "a COMPLETED mission is no longer judged: it ends",
        "block `judge` is gone, a `Judge`",
    ]
