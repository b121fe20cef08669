"""Fields of an app's own, while it is written: offered, explained, listed, edited and renamed."""

from __future__ import annotations

import pytest

from plutoc.edits import applied
from plutoc.service.completion.complete import complete
from plutoc.service.document import Document
from plutoc.service.editing.edit import CannotEdit, edit
from plutoc.service.editing.operations import Declare, Operation, RemoveDeclaration, Rename, Rewrite
from plutoc.service.hooks.help import complete as complete_in_hooks
from plutoc.service.hooks.help import hover as hover_in_hooks
from plutoc.service.picture.view import view
from plutoc.service.reading.hover import hover
from plutoc.service.reading.outline import outline
from plutoc.source import Source

GRAPH = """
  create = MissionCreator
  wait = Clock
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  judge = MissionEvaluator(hook: find_blooms, least: 3)
  note = MissionModifier(hook: note_it)

  start -> create -> wait -> note -> allocate -> launch -> watch
  watch -> wait when STANDBY
  watch -> end when FAILED
  watch -> judge when COMPLETED
  judge -> wait when STANDBY
  judge -> end otherwise
}
"""
APP = f"""pluto 1

app field {{
  mission has owner: text, margin: time = 10 min  # which is theirs
  trip has owner: text = "", depth: length = 30 cm

  action spray(dose: mass) -> float once
  evaluator find_blooms(least: int = 2)
  modifier note_it writes margin
{GRAPH}"""
HOOKS = """from . import Context, Drone, Mission, Results, Trip, Verdict


async def spray(drone: Drone, trip: Trip, context: Context, *, dose: float) -> float:
    return dose if trip.owner else 0.0


def find_blooms(mission: Mission, results: Results, *, least: int) -> Verdict:
    owner = mission.owner
    for one in mission.completed_trips:
        if one.owner != owner:
            return Verdict(add=[Trip(name="again", action="measure", target=(1, 2), owner=owner)])
    return Verdict(log=[mission.owner, f"{mission.current.owner}"])


def note_it(mission: Mission, context: Context) -> None:
    mission.margin += 1.0
"""


def document(text: str = APP) -> Document:
    hooks = Source("hooks.py", HOOKS)
    return Document(path="field.pluto", text=text, find_hooks=lambda _: hooks)


def done(text: str, *operations: Operation) -> str:
    for each in operations:
        edits = edit(Document(path="field.pluto", text=text), each).edits
        text = applied(Source("field.pluto", text), edits)
    return text


def test_the_app_of_these_tests_is_sound() -> None:
    assert [one.code for one in document().diagnostics] == ["P2055"]


@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("@", {"mission", "trip", "action"}),
        ("mission @", {"has"}),
        ("mission has @", {"limit", "note"}),
        ("trip has limit: time, @", {"note"}),
        ("trip has limit: @", {"time", "text", "percent"}),
        ("trip has limit: time = 5 @", {"min", "h"}),
        ("trip has soft: bool = @", {"yes", "no"}),
        ("action look @", {"->", "once"}),
        ("action look -> @", {"photo", "float", "mass"}),
        ("action look -> float @", {"safe", "ask"}),
        ("evaluator find_pests(@", {"limit", "count"}),
    ],
)
def test_what_is_legal_is_offered(line: str, offered: set[str]) -> None:
    text = APP.replace("  create =", f"  {line}\n  create =")
    items = complete(Document(path="a.pluto", text=text.replace("@", "")), text.index("@"))
    assert offered <= {item.label for item in items}


def test_no_name_is_offered_that_is_taken() -> None:
    """Nor one that an app without a value for it would need."""
    text = APP.replace("depth: length", "limit: length").replace(
        "  create =", "  trip has @\n  create ="
    )
    items = complete(Document(path="a.pluto", text=text.replace("@", "")), text.index("@"))
    assert "limit" not in {item.label for item in items}


@pytest.mark.parametrize(
    ("place", "within", "words"),
    [
        (
            "owner",
            "mission has owner",
            ["mission has owner: text", "must be filled in", "mission.owner"],
        ),
        ("margin", "margin: time", ["margin: time = 10 min", "may be left out", "in seconds"]),
        ("depth", "depth: length", ["trip has depth: length = 0.3 m", "trip.depth"]),
        ("margin", "writes margin", ["mission has margin"]),
        ("float", "-> float", ["Written as a number"]),
        ("least", "hook: find_blooms, least", ["int of `find_blooms`; default 2"]),
        ("has", "mission has", ["fields, each with its type"]),
    ],
)
def test_what_stands_there_is_explained(place: str, within: str, words: list[str]) -> None:
    found = hover(document(), APP.index(within) + within.index(place))
    assert found is not None
    for word in words:
        assert word in found.markdown


def test_a_photo_is_explained() -> None:
    text = APP.replace("-> float", "-> photo")
    found = hover(document(text), text.index("photo"))
    assert found is not None and "`take_photo`" in found.markdown


def test_the_outline_has_each_field() -> None:
    (app,) = outline(document())
    listed = [(one.name, one.detail) for one in app.children[:4]]
    assert listed == [
        ("owner", "mission has, text"),
        ("margin", "mission has, time"),
        ("owner", "trip has, text"),
        ("depth", "trip has, length"),
    ]


def test_hooks_are_helped_with_them() -> None:
    code = "def find_blooms(mission, results, *, least):\n    mission."
    labels = {one.label for one in complete_in_hooks(document(), code, len(code))}
    assert {"owner", "margin"} <= labels and "depth" not in labels


def test_hooks_are_told_what_results_can_be() -> None:
    code = (
        "def find_blooms(mission: Mission, results: Results, *, least):\n    results.new[0].value"
    )
    found = hover_in_hooks(document(), code, len(code))
    assert found is not None and "float | Photo | None" in found.markdown


def test_the_view_has_them_as_written() -> None:
    shown = view(document(), {})["fields"]
    assert isinstance(shown, list)
    assert [(one["name"], one["text"], one["required"]) for one in shown] == [
        ("mission.owner", "owner: text", True),
        ("mission.margin", "margin: time = 10 min", False),
        ("trip.owner", 'owner: text = ""', False),
        ("trip.depth", "depth: length = 30 cm", False),
    ]
    assert all(APP[one["from"] : one["to"]] == one["text"] for one in shown)


def test_a_field_is_renamed_wherever_it_is_that_one() -> None:
    """`owner` of missions, and not that of trips: by what the names around it are."""
    found = edit(document(), Rename(name="mission.owner", new="client"))
    text = applied(Source("field.pluto", APP), found.edits)
    assert text == APP.replace("mission has owner", "mission has client")
    assert "where one has `owner`, write `client`" in found.note
    hooks = applied(Source("hooks.py", HOOKS), found.hooks)
    assert hooks == HOOKS.replace("mission.owner", "mission.client")
    found = edit(document(), Rename(name="trip.owner", new="client"))
    hooks = applied(Source("hooks.py", HOOKS), found.hooks)
    for old in ("trip.owner", "one.owner", "owner=owner", "mission.current.owner"):
        assert old in HOOKS and old not in hooks
    assert "owner = mission.owner" in hooks and "client=owner" in hooks


def test_what_a_modifier_writes_is_renamed_with_it() -> None:
    text = done(APP, Rename(name="mission.margin", new="slack"))
    assert "slack: time = 10 min  # which is theirs" in text and "writes slack" in text


@pytest.mark.parametrize(
    ("wanted", "why"),
    [
        (Rename(name="mission.owner", new="status"), "every mission of this app has a `status`"),
        (Rename(name="trip.owner", new="delay"), "every trip of this app has a `delay`"),
        (Rename(name="mission.owner", new="margin"), "`margin` is declared already"),
        (Rename(name="mission.owner", new="Client"), "snake_case"),
        (Rename(name="mission.owner", new="class"), "a word of Python"),
        (Rename(name="mission.depth", new="height"), "declares no field `depth` of missions"),
        (Rewrite(name="mission.owner", text="client: text"), "rename it"),
        (Rewrite(name="mission.owner", text="owner: text, b: int"), "one field stands here"),
        (Rewrite(name="mission.owner", text="owner"), "this is no field"),
        (Rewrite(name="mission.owner", text="owner: text\n  x = Clock"), "one field stands here"),
        (RemoveDeclaration(name="trip.margin"), "declares no field `margin` of trips"),
        (RemoveDeclaration(name="mission.margin"), "`note_it` writes `margin`: change it first"),
        (Declare(text="trip has depth: int"), "`depth` is declared already"),
    ],
)
def test_what_cannot_be_done_is_said(wanted: Operation, why: str) -> None:
    with pytest.raises(CannotEdit, match=why):
        edit(document(), wanted)


def test_a_field_is_written_anew_and_taken_out() -> None:
    text = done(APP, Rewrite(name="mission.margin", text="margin: time"))
    assert "mission has owner: text, margin: time  # which is theirs" in text
    assert "mission has margin: time = 10 min  #" in done(
        APP, RemoveDeclaration(name="mission.owner")
    )
    text = done(
        APP,
        Rewrite(name="note_it", text="modifier note_it"),
        RemoveDeclaration(name="mission.margin"),
    )
    assert "mission has owner: text  # which is theirs" in text
    text = done(text, RemoveDeclaration(name="mission.owner"))
    assert "mission has" not in text and "# which is theirs" in text


def test_a_new_one_stands_with_the_others() -> None:
    text = done(APP, Declare(text="mission has urgent: bool = no"))
    assert "depth: length = 30 cm\n  mission has urgent: bool = no\n\n  action" in text
    empty = "pluto 1\n\napp ward {\n  create = MissionCreator\n}\n"
    assert done(empty, Declare(text="trip has note: text")) == empty.replace(
        "{\n", "{\n  trip has note: text\n\n"
    )
