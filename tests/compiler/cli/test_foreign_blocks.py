"""Blocks of another package: what is wrong with them is told with its name, and never in silence."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.compiler.cli.conftest import FIELD_APP, declare, tree
from tests.kit.command import plutoc

STEP_BESIDE = """
from plutoc.block import ANY_SAME, Block
def chime(run, status): return status
BLOCKS = [Block(name="Chime", doc="Chimes.", step=chime, transitions=ANY_SAME)]
"""


def test_a_block_that_cannot_be_carried_along_ends_with_1(
    app: Path, here: Path, installed: Path
) -> None:
    """The report says where in that package, and what to change. Nothing is written."""
    module = installed / "field_kit.py"
    module.write_text(STEP_BESIDE)
    app.write_text(FIELD_APP)
    before = tree(here)
    assert plutoc("check", app).code == 0
    said = plutoc("compile", app)
    assert said.code == 1
    assert "[P4009]: the package cannot carry this app's blocks along" in said.err
    assert f"{module}:2: plutoc.block is neither of the standard library" in said.err
    assert tree(here) == before


DECLARED = """
import sys
from plutoc.block import ANY_SAME, Block, Choice, HookParam, Narrowed, Param, Type
def chime(run, status): return status
class Odd:
    def __eq__(self, other): raise ValueError
    def __getattribute__(self, name): raise ValueError
class Exits(dict):
    def items(self): raise SystemExit
BLOCKS = [Block(**{{"name": "Chime", "doc": "Chimes.", "step": chime, "transitions": ANY_SAME, {}}})]
"""


@pytest.mark.parametrize(
    ("fact", "says"),
    [
        ('"step": lambda run, status: status', "its `step` must be a function that its module has"),
        ('"step": Odd()', "it cannot be looked at: ValueError"),
        ('"limit": 5', "its `limit` must be a function, not 5"),
        ('"transitions": {1: 2}', "its `transitions` must give a set of statuses for each status"),
        ('"params": (1,)', "its `params` holds 1, which is no Param or HookParam or Choice"),
        ('"params": (Param(name="a b", type=1, doc=""),)', "holds a parameter whose name is 'a b'"),
        ('"params": (HookParam(name="a", kind=1, doc=""),)',
         "a parameter a whose facts are not of"),
        ('"narrowed": (Narrowed(param="a", value=1, emits=None),)',
         "its `narrowed` holds Narrowed"),
        ('"params": (Choice(name="a", options={"b": lambda: 1}, default="b", doc=""),)',
         "a parameter a with a function that its module has not under its name"),
        ('"params": (Param(name="a", type=Type.INT, doc="", default=10**5000),)',
         "a parameter a whose"),
        ('"params": (Param(name="a", type=Type.TEXT, doc="", default="\\x1b"),)',
         "a parameter a whose"),
        ('"params": (Param(name="class", type=Type.INT, doc=""),)',
         "a parameter whose name is 'class'"),
        ('"transitions": Exits()', "it cannot be looked at: SystemExit"),
        ('"reads": ("a", 5)', "its `reads` holds 5, which is no str"),
        ('"named": "yes"', "its `named` must be True or False, not 'yes'"),
        ('"bound": 3', "its `bound` must be a parameter's name, not 3"),
        ('"gate": "first"', "its `gate` must be a Gate, not 'first'"),
        ('"name": "\\x1b[31m"', "its `name` must be a name as Python has them"),
        ('"doc": "\\x1b[31m"', "its `doc` must be a text that can be shown"),
        ('"name": sys.exit("\\x1b]0;x\\x07")',
         "cannot be loaded from field_kit:BLOCKS: SystemExit"),
    ],
)  # fmt: skip
def test_a_block_is_declared_as_blocks_are(
    fact: str, says: str, app: Path, here: Path, installed: Path
) -> None:
    """What is not is told with the package and the block; and no word of it commands a terminal."""
    (installed / "field_kit.py").write_text(DECLARED.format(fact))
    app.write_text(FIELD_APP)
    said = plutoc("check", app)
    assert said.code == 1
    assert says in said.err
    assert "field_kit" in said.err
    assert all(char.isprintable() or char == "\n" for char in said.err + said.out)


def test_a_block_that_was_never_made_is_none(app: Path, installed: Path) -> None:
    """It has not even a name."""
    (installed / "field_kit.py").write_text(
        "from plutoc.block import Block\nBLOCKS = [object.__new__(Block)]\n"
    )
    app.write_text(FIELD_APP)
    said = plutoc("check", app)
    assert said.code == 1
    assert "one of its blocks of field_kit is not declared as a block is" in said.err


SIMPLE = "def chime(run, status):\n    {}\n"


@pytest.mark.parametrize(
    "code",
    [
        "import sys; sys.exit(0)",
        "import os; os._exit(0)",
        "raise GeneratorExit",
        "raise KeyboardInterrupt",
        "class Odd(BaseException): pass\nraise Odd('gone')",
        "def blocks():\n    raise SystemExit(0)\n    yield\nBLOCKS = blocks()",
    ],
)
def test_a_package_that_ends_python_as_it_is_imported_is_named(
    app: Path, here: Path, installed: Path, code: str
) -> None:
    """`sys.exit(0)` would pass for a compile that went well, and there would be no package."""
    (installed / "field_kit.py").write_text(code)
    app.write_text(FIELD_APP)
    said = plutoc("compile", app)
    assert said.code == 1
    assert "the blocks of field_kit cannot be loaded from field_kit:BLOCKS" in said.err
    assert not (here / "crop").exists()


@pytest.mark.long
@pytest.mark.process
@pytest.mark.parametrize(
    "error",
    [
        "SystemExit(0)",
        "GeneratorExit()",
        "__import__('asyncio').CancelledError()",
        "__import__('os')._exit(0)",
    ],
)
def test_a_step_that_ends_python_is_its_blocks_fault(
    app: Path, installed: Path, error: str
) -> None:
    """The simulation does not end as if all were well, or by a traceback."""
    declare(installed, SIMPLE.format(f"raise {error}"))
    app.write_text(FIELD_APP)
    said = plutoc("run", app)
    assert said.code == 70
    assert "in block chime" in said.err
    assert "Traceback" not in said.err


def test_a_step_is_asked_by_the_status_that_came(app: Path, installed: Path) -> None:
    """STANDBY and FAILED may both come and both be given; but not the one for the other."""
    step = """
from plutoc_runtime.domain.status import Status

async def chime(run, status):
    if status is Status.FAILED:
        return Status.STANDBY
    return status
"""
    declare(installed, step)
    app.write_text(
        FIELD_APP.replace("create -> chime -> allocate", "create -> allocate")
        .replace("watch -> allocate when STANDBY", "watch -> chime when STANDBY")
        .replace("watch -> retry when FAILED", "watch -> chime when FAILED")
        .replace(
            "retry -> allocate when STANDBY",
            "chime -> allocate when STANDBY\n  chime -> retry when FAILED\n"
            "  retry -> allocate when STANDBY",
        )
    )
    assert plutoc("compile", app).code == 0
    flow = Path("crop/src/crop/flow.py").read_text()
    assert "{STANDBY: (STANDBY,), FAILED: (FAILED,)}[status]" in "".join(flow.split("\n"))
