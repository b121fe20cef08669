"""Edits of an app by operations: what is meant, no more, and back again."""

from __future__ import annotations

from dataclasses import fields

import pytest

from plutoc.edits import applied
from plutoc.registry import Blocks, standard
from plutoc.service.document import Document
from plutoc.service.editing.edit import CannotEdit, edit
from plutoc.service.editing.operations import (
    KINDS,
    AddBlock,
    Declare,
    NotAnOperation,
    Operation,
    Paste,
    Rename,
    Rewrite,
    SetArgument,
    operation,
)
from plutoc.source import Source
from tests.service.sequences import Tally, run


def done(text: str, *operations: Operation) -> str:
    for each in operations:
        edits = edit(Document(path="a.pluto", text=text), each).edits
        text = applied(Source("a.pluto", text), edits)
    return text


def test_random_sequences_of_edits_do_what_was_meant() -> None:
    """A share of `python -m tests.service`; nearly every operation turns up."""
    tally = Tally()
    for seed in range(20):
        run(seed, tally)
    assert len(tally.done) > len(KINDS)


FORK = "pluto 1\napp a {\n  x = Clock\n  y = Clock\n  z = Clock\n  x -> [y, z]\n}\n"


@pytest.mark.parametrize(
    "wanted",
    [
        Paste(text="w = Clock(\r\n  at: 5 min\r\n)\r\n"),
        Rewrite(name="y", text="y = Clock(\r\n  at: 5 min\r\n)"),
        Declare(text="w = Clock(\r\n  at: 5 min\r\n)"),
        SetArgument(owner="y", parameter="at", value="[\r\n1]"),
    ],
    ids=lambda one: type(one).__name__,
)
def test_a_text_from_elsewhere_gets_the_line_ends_of_the_app(wanted: Operation) -> None:
    written = done(FORK.replace("\n", "\r\n"), wanted)
    assert written == done(FORK, wanted).replace("\n", "\r\n")


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_a_package_comes_in_below_the_header(end: str, monkeypatch: pytest.MonkeyPatch) -> None:
    kit = Blocks(packages=("std", "kit"), of=lambda _: standard().of("std"))
    monkeypatch.setattr("plutoc.service.editing.declarations.blocks", lambda: kit)
    text = "# ours\npluto 1  # first\n\napp a {\n}\n".replace("\n", end)
    whole = "# ours\npluto 1  # first\nuse kit\n\napp a {\n  clock = kit.Clock\n}\n"
    assert done(text, AddBlock(kind="kit.Clock")) == whole.replace("\n", end)
    with pytest.raises(CannotEdit, match="does not begin with `pluto 1`"):
        done("app a {\n}\n", AddBlock(kind="kit.Clock"))


HOOKS = """from . import Mission, Results, Verdict


def judge(mission: Mission, results: Results) -> Verdict:
    return Verdict()


def again(judge: int) -> int:
    return judge


def twice(mission: Mission, results: Results) -> Verdict:
    return judge(mission, results)
"""


def test_a_hook_is_renamed_in_its_module_too() -> None:
    text = "pluto 1\napp a {\n  evaluator judge\n  j = MissionEvaluator(hook: judge)\n  c = MissionCreator\n  start -> c\n}\n"
    found = Document(path="a.pluto", text=text)
    hooks = Source("hooks.py", HOOKS)
    object.__setattr__(found, "hooks", hooks)
    edited = edit(found, Rename(name="judge", new="assess"))
    renamed = applied(hooks, edited.hooks)
    assert "def assess(mission" in renamed and "return assess(mission" in renamed
    assert "def again(judge: int) -> int:\n    return judge\n" in renamed
    assert "hook: assess" in applied(found.source, edited.edits)


@pytest.mark.parametrize("name", KINDS)
def test_operations_come_as_plain_data(name: str) -> None:
    samples = {
        "str": "x",
        "str | None": None,
        "bool": False,
        "tuple[str, ...]": ["x"],
        "Mapping[str, str]": {"a": "b"},
        "Arrow": {"source": "x", "target": "y"},
    }
    kind = KINDS[name]
    data = {one.name: samples[str(one.type)] for one in fields(kind)}
    assert isinstance(operation({"do": name, **data}), kind)
    for field in data:
        with pytest.raises(NotAnOperation, match=field):
            operation({"do": name, **data, field: 7.5})
    with pytest.raises(NotAnOperation, match="strange"):
        operation({"do": name, **data, "strange": 1})


@pytest.mark.parametrize("data", [None, [], {}, {"do": "Fly"}, {"do": "Connect"}, {"do": 3}])
def test_what_is_no_operation_is_refused(data: object) -> None:
    with pytest.raises(NotAnOperation):
        operation(data)
