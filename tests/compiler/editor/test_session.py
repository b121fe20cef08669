"""What clients ask, and what all are told."""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.editor.session import Session
from plutoc.project.reading import UsageError

from .editing import APP, HOOKED, Page, app_in


async def test_a_client_is_told_all_there_is(tmp_path: Path) -> None:
    hello = await Page(Session(app_in(tmp_path, "\ufeff" + APP.replace("\n", "\r\n")))).next()
    assert hello["push"] == "hello"
    assert hello["text"] == APP
    assert hello["hooks"] is None
    assert hello["file"] == "farm.pluto"
    assert [one["name"] for one in hello["view"]["blocks"]] == [
        "create",
        "allocate",
        "launch",
        "watch",
    ]
    watch = hello["view"]["blocks"][3]
    assert APP.encode("utf-16-le")[2 * watch["from"] : 2 * watch["to"]].decode("utf-16-le") == (
        "watch = TripMonitor"
    )
    assert {one["kind"] for one in hello["palette"]} >= {"Clock", "GateFIFO"}


async def test_an_edit_of_the_picture_is_an_edit_of_the_text_for_all(tmp_path: Path) -> None:
    session = Session(app_in(tmp_path))
    one, other = Page(session), Page(session)
    operations = [
        {"do": "AddBlock", "kind": "PriorityManager"},
        {"do": "Connect", "arrow": {"source": "watch", "target": "", "when": ["FAILED"]}},
    ]
    answer = await one.ask("edit", operations=operations, positions={"": [48, 96]}, version=0)
    (name,) = answer["new"]
    push = await other.told("change", file="app")
    assert (push["by"], push["new"]) == (one.client.number, [name])
    moved = await other.told("change", file="layout")
    (block,) = (each for each in moved["view"]["blocks"] if each["name"] == name)
    assert (block["x"], block["y"], block["moved"]) == (48, 96, True)
    assert f"watch -> {name} when FAILED" in session.files.history.app
    assert (await other.ask("undo"))["version"] == 4  # one step, by whomever
    assert session.files.history.app == APP
    assert dict(session.files.history.positions) == {}


async def test_a_new_name_goes_into_the_hooks_and_the_layout_and_back_in_one_step(
    tmp_path: Path,
) -> None:
    hooks = "\ufeff# é 🚁\r\ndef judge(trip, candidates):\r\n    return judge\r\n"
    session = Session(app_in(tmp_path, HOOKED.replace("\n", "\r\n"), hooks))
    page = Page(session)
    before = (session.files.history.app, session.files.history.hooks)
    await page.ask("edit", operation={"do": "Rename", "name": "judge", "new": "decide"})
    assert session.files.history.hooks == hooks.replace("judge", "decide")
    await page.ask("place", positions={"watch": [8, 8]})
    await page.ask("edit", operation={"do": "Rename", "name": "watch", "new": "follow"})
    assert dict(session.files.history.positions) == {"follow": (8, 8)}
    await page.ask("edit", operation={"do": "RemoveBlocks", "names": ["follow"]})  # no app any more
    await page.ask("edit", operation={"do": "Rename", "name": "decide", "new": "weigh"})
    assert "def weigh(" in (session.files.history.hooks or "")
    assert dict(session.files.history.positions) == {}
    for _ in range(5):
        await page.ask("undo")
    assert (session.files.history.app, session.files.history.hooks) == before


async def test_what_cannot_be_done_is_said_in_a_sentence_and_changes_nothing(
    tmp_path: Path,
) -> None:
    session = Session(app_in(tmp_path))
    page = Page(session)
    nowhere = {"do": "Connect", "arrow": {"source": "watch", "target": "nowhere"}}
    for op, given in (
        ("edit", {"operation": nowhere}),
        ("edit", {"operations": [{"do": "AddBlock", "kind": "Clock"}, {"do": "Explode"}]}),
        ("edit", {}),
        ("fix", {"problem": 0}),
        ("stub", {"name": "judge"}),
        ("explain", {"code": "P0"}),
        ("resolve", {"keep": "ours"}),
        ("run", {"missions": "../missions.toml"}),
        ("run", {"missions": "other.toml"}),
        ("fly", {}),
    ):
        answer = await page.ask(op, **given)
        assert answer["error"]
        assert "\n" not in answer["error"]
    assert (session.files.history.app, session.files.history.version) == (APP, 0)


async def test_words_typed_into_what_others_changed_come_back_with_the_text(tmp_path: Path) -> None:
    session = Session(app_in(tmp_path))
    one, other = Page(session), Page(session)
    place = APP.index("A farm")
    await one.type(place, "", place + 6)
    answer = await other.type(place + 2, "big ", version=0)
    assert answer["stale"] is True
    assert answer["text"] == session.files.history.app == APP.replace("A farm", "")
    assert (await other.type(0, "# hi\n", version=0))["version"] == 2


async def test_a_problem_that_can_be_mended_is(tmp_path: Path) -> None:
    twice = "  watch -> end otherwise\n"
    session = Session(app_in(tmp_path, APP.replace(twice, 2 * twice)))
    page = Page(session)
    view = (await page.next())["view"]
    (index,) = (i for i, one in enumerate(view["problems"]) if one["fix"])
    await page.ask("fix", problem=index)
    assert session.files.history.app == APP


async def test_stubs_are_written_where_there_is_no_file_and_where_there_is_one(
    tmp_path: Path,
) -> None:
    session = Session(app_in(tmp_path, HOOKED))
    page = Page(session)
    answer = await page.ask("stub", name="judge")
    hooks = session.files.hooks
    assert hooks is not None
    assert hooks.text[answer["from"] :].startswith("def judge(")
    push = await page.told("change", file="hooks")
    assert push["hooks"] == "hooks.py"
    assert push["view"]["hooks"][0]["defined"] is True
    end = len(hooks.text)
    where = hooks.text.index("def judge(")
    await page.type(where, "", end, file="hooks")
    again = await page.ask("stub", name="judge")
    assert again["line"] > 1
    version = session.files.history.version
    there = await page.ask("stub", name="judge")  # it is there already
    assert (there["line"], session.files.history.version) == (again["line"], version)
    for _ in range(3):
        await page.ask("undo")
    assert session.files.history.hooks is None


async def test_a_hook_leads_to_its_function(tmp_path: Path) -> None:
    hooks = "# 🚁\r\n\r\ndef judge(trip, candidates):\r\n    return 1\r\n"
    page = Page(Session(app_in(tmp_path, HOOKED, hooks)))
    shown = (await page.next())["hooks"]["text"]
    answer = await page.ask("definition", offset=HOOKED.index("judge)"))
    declared, function = answer["places"]
    assert (declared["file"], declared["from"]) == ("app", HOOKED.index("judge\n"))
    assert (function["file"], function["line"]) == ("hooks", 3)
    assert function["from"] == shown.index("def") + 1  # the helicopter counts two


async def test_where_an_edge_may_lead_and_why_not(tmp_path: Path) -> None:
    page = Page(Session(app_in(tmp_path)))
    targets = (await page.ask("ports", source="watch", when=[]))["targets"]
    assert targets["allocate"] is None
    assert "RUNNING" in targets["watch"]
    assert "missions begin" in targets["create"]
    targets = (await page.ask("ports", source="watch", when=["STANDBY"]))["targets"]
    assert "there already" in targets["allocate"]
    assert "does not take STANDBY" in targets["end"]
    targets = (await page.ask("ports", source="start", when=[]))["targets"]
    assert "already" in targets["create"]


async def test_a_client_that_does_not_read_is_let_go(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("plutoc.editor.session.BEHIND", 28_000)
    session = Session(app_in(tmp_path))
    slow, other = session.join(), Page(session)
    for _ in range(10):
        await other.type(0, "# more\n")
    texts = []
    while (text := await slow.next()) is not None:
        texts.append(text)
    assert texts == [] or len("".join(texts)) <= 28_000


async def test_a_mistake_of_ours_ends_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The text is changed and told all the same; a person is told that the picture is not drawn."""
    session = Session(app_in(tmp_path))
    page = Page(session)
    await page.next()

    def broken(*_: object, **__: object) -> None:
        raise KeyError("x")

    monkeypatch.setattr("plutoc.editor.session.view", broken)
    await page.type(0, "# hi\n")
    push = await page.told("change")
    assert push["view"]["problems"][0]["code"] == "P9001"
    assert push["view"]["blocks"]
    monkeypatch.setattr("plutoc.editor.gestures.formatted", broken)
    monkeypatch.delenv("PLUTO_DEBUG", raising=False)
    capsys.readouterr()
    assert "P9001" in (await page.ask("format"))["error"]
    told = capsys.readouterr().err
    assert "P9001" in told
    assert "Traceback" not in told
    monkeypatch.setenv("PLUTO_DEBUG", "1")
    await page.ask("format")
    assert "Traceback" in capsys.readouterr().err


def test_a_new_app_is_named_after_its_file(tmp_path: Path) -> None:
    for name, app in (
        ("crop_watch", "crop_watch"),
        ("Crop-Watch 2", "crop_watch_2"),
        ("7", "my_app"),
        ("end", "my_app"),
    ):
        session = Session(tmp_path / f"{name}.pluto")
        assert session.files.history.app == f"pluto 1\n\napp {app} {{\n}}\n"
    (tmp_path / "field").mkdir()
    assert "app field {" in Session(tmp_path / "field" / "app.pluto").files.history.app
    assert [one.name for one in tmp_path.iterdir()] == ["field"]


@pytest.mark.parametrize(
    "name",
    ["hooks.py", "missions.toml", "none/app.pluto", "folder.pluto", "link.pluto", "latin.pluto"],
)
def test_what_is_no_app_is_refused(tmp_path: Path, name: str) -> None:
    (tmp_path / "folder.pluto").mkdir()
    (tmp_path / "link.pluto").symlink_to(app_in(tmp_path))
    (tmp_path / "latin.pluto").write_bytes("app é".encode("latin-1"))
    with pytest.raises(UsageError):
        Session(tmp_path / name)


async def test_what_may_stand_at_a_place_and_what_it_means(tmp_path: Path) -> None:
    """In both texts, at the places that a browser counts."""
    hooks = "\ufeff# 🚁\r\ndef judge(trip, candidates):\r\n    trip.\r\n"
    page = Page(Session(app_in(tmp_path, "\ufeff" + HOOKED.replace("\n", "\r\n"), hooks)))
    hello = await page.next()
    before = HOOKED.index("STANDBY\n") + 1  # the helicopter before counts two
    answer = await page.ask("complete", file="app", offset=before + 3)
    (item,) = (one for one in answer["items"] if one["label"] == "STANDBY")
    assert (item["from"], item["kind"]) == (before, "status")
    answer = await page.ask("hover", file="app", offset=HOOKED.index("TripLauncher") + 2)
    assert "TripLauncher" in answer["markdown"]
    shown = hello["hooks"]["text"]
    answer = await page.ask("complete", file="hooks", offset=shown.index("trip.\n") + 6)
    assert "target" in {one["label"] for one in answer["items"]}
    answer = await page.ask("hover", file="hooks", offset=0)
    assert answer["markdown"] == ""
    assert "error" in await page.ask("hover", file="hooks", offset=10_000)
