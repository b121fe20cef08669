"""What an editor shows of an app: as the compiler knows it, as it is written, in plain data."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from plutoc.registry import blocks_of
from plutoc.service.document import Document
from plutoc.service.picture.arguments import as_written
from plutoc.service.picture.palette import palette
from plutoc.service.picture.ports import targets
from plutoc.service.picture.view import view
from plutoc.source import Source
from plutoc_runtime.domain.quantities import Type
from tests.paths import ROOT
from tests.test_cases import FOLDERS, read

SOME = [folder for folder in FOLDERS[::3] if "many" not in folder.name]
EXAMPLES = sorted((ROOT / "examples").glob("*/app.pluto"))


def seen(text: str, hooks: Source | None = None) -> dict[str, Any]:
    """Return the view as a client has it."""
    document = Document(path="app.pluto", text=text, find_hooks=lambda _: hooks)
    data: dict[str, Any] = json.loads(json.dumps(view(document, {}, hooks=hooks)))
    return data


@pytest.mark.parametrize("folder", SOME, ids=lambda folder: folder.name)
def test_every_problem_is_shown_at_its_place_and_at_its_blocks(folder: Path) -> None:
    """With the very codes and spans of `plutoc check`, for mistakes of all kinds."""
    source, hooks = read(folder / "app.pluto"), read(folder / "hooks.py")
    assert source is not None
    document = Document(path=source.path, text=source.text, find_hooks=lambda _: hooks)
    shown = seen(source.text, hooks)
    assert [
        (one["code"], one["severity"], one["from"], one["to"]) for one in shown["problems"]
    ] == [(one.code, one.severity.value, *one.span) for one in document.diagnostics]
    names = {one["name"] for one in shown["blocks"]}
    for index, problem in enumerate(shown["problems"]):
        assert set(problem["blocks"]) <= names
        marked = {one["name"] for one in shown["blocks"] if index in one["problems"]}
        assert marked == set(problem["blocks"])
    ends = {"start", "end", *(one["name"] for one in shown["events"])}
    for edge in shown["edges"]:
        assert {edge["source"], edge["target"]} <= names | ends


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.parent.name)
def test_edges_carry_the_statuses_that_the_compiler_found(path: Path) -> None:
    text = path.read_text()
    document = Document(path="", text=text)
    assert document.checked is not None
    shown = seen(text)
    found = [
        (one["source"], one["target"], set(one["statuses"]))
        for one in shown["edges"]
        if not one["implicit"]
    ]
    assert found == [
        (edge.source, edge.target, {status.value for status in document.checked.carries[edge]})
        for edge in document.graph.edges
    ]
    for one in shown["edges"]:
        written = text[one["from"] : one["to"]]
        assert written.startswith(one["source"])
        assert written.endswith(
            ("otherwise", *one["when"]) if one["when"] or one["otherwise"] else one["target"]
        )
    for one in shown["blocks"]:
        assert text[one["from"] : one["to"]].startswith(f"{one['name']} = {one['kind']}")
        for argument in one["arguments"]:
            assert (
                argument["written"] is None or argument["written"] in text[one["from"] : one["to"]]
            )


def test_forks_ends_that_nobody_wrote_and_gates_are_shown() -> None:
    shown = seen((ROOT / "examples" / "alfalfa" / "app.pluto").read_text())
    assert [one["target"] for one in shown["edges"] if one["fork"]] == ["watch", "timer"]
    assert [one["name"] for one in shown["blocks"] if one["gate"]] == ["first"]
    action, evaluator = shown["hooks"]
    assert (action["kind"], evaluator["kind"]) == ("action", "evaluator")
    assert action["parameters"][0]["default"] == "50 mg"
    assert action["text"] == "action pollinate(dose: mass = 50 mg) once"
    sees = ["take_photo", "measure"]
    carries = ["pick_item", "release_item", "pollinate"]
    assert [one["can"] for one in shown["categories"]] == [sees, carries, sees, carries]
    (judge,) = (one for one in shown["blocks"] if one["name"] == "judge")
    assert judge["hook"] == "find_blooms"


def test_hooks_know_where_they_are_defined() -> None:
    text = "pluto 1\napp a {\n  evaluator b\n  evaluator c\n}\n"
    hooks = Source("hooks.py", "import x\n\ndef b(mission, results):\n    return 1\n")
    found = [(one["defined"], one["hooks_line"]) for one in seen(text, hooks)["hooks"]]
    assert found == [(True, 3), (False, None)]
    assert not seen(text, Source("hooks.py", "def b("))["hooks"][0]["defined"]


@pytest.mark.parametrize(
    ("value", "kind", "text"),
    [
        (300.0, Type.TIME, "5 min"),
        (90.0, Type.TIME, "90 s"),
        (5e-05, Type.MASS, "50 mg"),
        (0.2, Type.PERCENT, "20 %"),
        (293.15, Type.TEMPERATURE, "20 C"),
        (3, Type.INT, "3"),
        (True, Type.BOOL, "yes"),
        ('a "b"', Type.TEXT, '"a \\"b\\""'),
    ],
)
def test_defaults_are_shown_as_an_app_writes_them(
    value: float | str, kind: Type, text: str
) -> None:
    assert as_written(value, kind) == text


def test_the_palette_has_every_kind_with_its_page() -> None:
    ours = [one for one in palette() if one["package"] == "std"]
    assert [one["kind"] for one in ours] == list(blocks_of("std"))
    assert all(str(one["doc"]).startswith(f"# {one['kind']}\n") for one in ours)
    (evaluator,) = (one for one in ours if one["hook"] == "evaluator")
    assert evaluator["emits"]


def test_a_broken_package_is_told_and_the_others_are_offered(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(
        "plutoc.service.picture.palette.installed_packages", lambda: ("std", "nowhere")
    )
    *ours, broken = palette()
    assert len(ours) == len(blocks_of("std"))
    assert broken == {
        "package": "nowhere",
        "broken": "no package of blocks named nowhere is installed",
    }


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.parent.name)
def test_every_edge_of_a_sound_app_might_have_been_drawn(path: Path) -> None:
    """But for the one that is drawn already: without it, its target can be reached."""
    document = Document(path="", text=path.read_text())
    for edge in document.graph.edges:
        if edge.guard_span is None or edge.otherwise:
            continue
        source = document.graph.source
        text = source.text
        without = Document(path="", text=text[: edge.span.start] + "# " + text[edge.span.start :])
        when = [status.value for status in edge.guard or ()]
        assert targets(without, edge.source, when)[edge.target] is None
