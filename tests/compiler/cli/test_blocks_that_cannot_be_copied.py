"""An app with a block of another package that cannot be copied into its package."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import FIELD_APP, Call, tree

STEP_BESIDE = """
from plutoc.block import ANY_SAME, Block
def chime(run, status): return status
BLOCKS = [Block(name="Chime", doc="Chimes.", step=chime, transitions=ANY_SAME)]
"""


def test_a_block_that_cannot_be_carried_along_ends_with_1(
    plutoc: Call, app: Path, here: Path, installed: Path
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
def odd(run, status): return status
odd.__name__ = "not a name\\x1b[31m"
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
        ('"step": odd', "its `step` must be a function that its module has"),
        ('"step": None', "its `step` must be a function, not None"),
        ('"step": Odd()', "it cannot be looked at: ValueError"),
        ('"limit": 5', "its `limit` must be a function, not 5"),
        ('"transitions": None', "its `transitions` must be a mapping of statuses"),
        ('"transitions": {1: 2}', "its `transitions` must give a set of statuses for each status"),
        ('"guarded": []', "its `guarded` must be a mapping of statuses"),
        ('"params": [1]', "its `params` must be a tuple, not [1]"),
        ('"params": (1,)', "its `params` holds 1, which is no Param or HookParam or Choice"),
        ('"params": (Param(name="a b", type=1, doc=""),)', "holds a parameter whose name is 'a b'"),
        ('"params": (Param(name="a", type=1, doc=""),)', "a parameter a whose facts are not of"),
        ('"params": (HookParam(name="a", kind=1, doc=""),)',
         "a parameter a whose facts are not of"),
        ('"params": (Choice(name="a", options=1, default=1, doc=""),)',
         "a parameter a whose facts"),
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
        ('"params": (Param(name="run", type=Type.INT, doc=""),)',
         "a parameter whose name is 'run'"),
        ('"transitions": Exits()', "it cannot be looked at: SystemExit"),
        ('"needs": None', "its `needs` must be a tuple, not None"),
        ('"reads": ("a", 5)', "its `reads` holds 5, which is no str"),
        ('"named": "yes"', "its `named` must be True or False, not 'yes'"),
        ('"bound": 3', "its `bound` must be a parameter's name, not 3"),
        ('"gate": "first"', "its `gate` must be a Gate, not 'first'"),
        ('"name": 5', "its `name` must be a name as Python has them, not 5"),
        ('"name": "\\x1b[31m"', "its `name` must be a name as Python has them"),
        ('"doc": "\\x1b[31m"', "its `doc` must be a text that can be shown"),
        ('"doc": None', "its `doc` must be a text that can be shown, not None"),
        ('"name": sys.exit("\\x1b]0;x\\x07")',
         "cannot be loaded from field_kit:BLOCKS: SystemExit"),
    ],
)  # fmt: skip
def test_a_block_is_declared_as_blocks_are(
    fact: str, says: str, plutoc: Call, app: Path, here: Path, installed: Path
) -> None:
    """What is not is told with the package and the block; and no word of it commands a terminal."""
    (installed / "field_kit.py").write_text(DECLARED.format(fact))
    app.write_text(FIELD_APP)
    for command in ("check", "compile"):
        said = plutoc(command, app)
        assert said.code == 1
        assert says in said.err
        assert "field_kit" in said.err
        assert all(char.isprintable() or char == "\n" for char in said.err + said.out)


def test_a_block_that_was_never_made_is_none(plutoc: Call, app: Path, installed: Path) -> None:
    """It has not even a name."""
    (installed / "field_kit.py").write_text(
        "from plutoc.block import Block\nBLOCKS = [object.__new__(Block)]\n"
    )
    app.write_text(FIELD_APP)
    said = plutoc("check", app)
    assert said.code == 1
    assert "one of its blocks of field_kit is not declared as a block is" in said.err


@pytest.mark.parametrize("name", ["a" * 300, "/".join(["a" * 300] * 20), "in/" + "b" * 300])
def test_a_place_that_cannot_be_is_told_in_a_sentence(name: str, plutoc: Call, app: Path) -> None:
    said = plutoc("compile", app, "-o", name)
    assert said.code == 2
    assert "File name too long" in said.err
    assert not Path("in").exists()


def test_a_pipe_in_the_place_of_the_hooks_is_not_waited_for(
    plutoc: Call, app: Path, here: Path
) -> None:
    """Nor taken for nothing, as a folder is not."""
    hooks = app.parent / "hooks.py"
    hooks.unlink(missing_ok=True)
    for make, what in ((os.mkfifo, "a pipe, a socket or a device"), (os.mkdir, "a folder")):
        make(hooks)
        for command, code in (("check", 1), ("compile", 3)):
            said = plutoc(command, app)
            assert said.code == code
            assert f"`hooks.py` is {what}" in said.err
        (hooks.rmdir if hooks.is_dir() else hooks.unlink)()
