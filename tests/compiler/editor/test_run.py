"""*Compile* and *Run*: what is shown is what the command line does, and what really flew."""

from __future__ import annotations

import asyncio
import re
import shutil
import tomllib
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from plutoc.cli import main
from plutoc.editor.compiling import Snapshot, written
from plutoc.editor.running import run
from plutoc.editor.sample_plan import sample_plan
from plutoc.editor.session import Session
from plutoc.service.document import Document
from plutoc.source import Source
from plutoc_runtime.domain.status import Status
from tests.paths import ROOT

from .editing import APP, HOOKED, Page, app_in, files_of

EXAMPLES = sorted((ROOT / "examples").glob("*/app.pluto"))


def snapshot(path: Path) -> Snapshot:
    hooks = path.with_name("hooks.py")
    source = Source(str(hooks), hooks.read_text()) if hooks.exists() else None
    return Snapshot(path=path, text=path.read_text(), hooks=source, hooks_path=hooks)


async def flown(path: Path, missions: str | None = None, seed: int = 1) -> dict[str, Any]:
    """Run the app at a path."""
    return dict(await run(snapshot(path), missions, seed))


def walked(document: Document, found: dict[str, Any]) -> None:
    """Missions come to blocks with statuses that come there, and each of them ends once."""
    assert document.checked is not None
    ended: Counter[str] = Counter()
    for _, mission, block, status, branch in found["events"]:
        if block == "end":
            ended[mission] += 1
            assert branch == 0
        else:
            assert Status(status) in document.checked.arrives[block], (mission, block, status)
    assert ended == dict.fromkeys(found["missions"], 1)


FLOWN = [
    # in the default run, one: with branches, a repeater, and hooks of its own
    pytest.param(path, marks=[] if path.parent.name == "alfalfa" else [pytest.mark.long])
    for path in EXAMPLES
]


@pytest.mark.process
@pytest.mark.parametrize("path", FLOWN, ids=lambda path: path.parent.name)
async def test_what_is_shown_of_a_run_is_what_its_missions_did(tmp_path: Path, path: Path) -> None:
    """And end as the trace says; by the plan beside the source, and by one that is made up without."""
    document = Document(path=str(path), text=path.read_text())
    found = await flown(path)
    assert found["exit"] == 0, found["log"]
    assert found["file"] == "missions.toml"
    walked(document, found)
    assert found["duration_s"] == max(event[0] for event in found["events"])

    for name in ("app.pluto", "hooks.py"):
        if path.with_name(name).exists():
            shutil.copy(path.with_name(name), tmp_path)
    before = files_of(tmp_path)
    found = await flown(tmp_path / "app.pluto")
    assert "3 of 3 missions completed" in found["log"]
    missions = tomllib.loads(found["plan"])["mission"]
    assert [len(one["trip"]) for one in missions] == [2, 2, 2]
    walked(document, found)
    assert files_of(tmp_path) == before


@pytest.mark.long  # a process flies
@pytest.mark.process
async def test_what_goes_wrong_in_a_run_is_shown_as_the_app_says_it(tmp_path: Path) -> None:
    path = app_in(tmp_path)
    (tmp_path / "missions.toml").write_text("[[mission]]\nname = 3\n")
    found = await flown(path, "missions.toml")
    assert found["exit"] == 2
    assert "missions.toml" in found["log"]
    assert found["events"] == []


@pytest.mark.long  # a process flies
@pytest.mark.process
async def test_a_run_without_end_is_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("plutoc.editor.running.LONGEST", 3.0)
    path = app_in(tmp_path, HOOKED)
    (tmp_path / "hooks.py").write_text(
        "def judge(trip, candidates):\n    while True:\n        pass\n"
    )
    found = await flown(path)
    assert found["exit"] == 128 + 9
    assert "was ended after" in found["log"]
    assert any(event[2] == "allocate" for event in found["events"])


async def test_compile_shows_what_it_would_change_and_then_changes_just_that(
    tmp_path: Path,
) -> None:
    path = app_in(tmp_path, HOOKED, "def judge(trip, candidates):\n    return candidates[0]\n")
    session = Session(path)
    page = Page(session)
    before = files_of(tmp_path)
    shown = await page.ask("compile", write=False)
    assert files_of(tmp_path) == before
    assert {one["status"] for one in shown["files"]} == {"new"}
    assert shown["folder"] == "farm"
    assert (await page.ask("compile", write=True))["written"] == len(shown["files"])
    written = {
        name.removeprefix("farm/") for name in files_of(tmp_path) if name.startswith("farm/")
    }
    assert written == {one["path"] for one in shown["files"]}
    assert main(["compile", str(path), "--check"]) == 0
    # from now on, the package's own hooks.py is the one that counts, and is edited
    assert session.files.hooks_path == tmp_path / "farm" / "src" / "farm" / "hooks.py"
    await page.ask("edit", operation={"do": "SetTitle", "title": "Two farms"})
    shown = await page.ask("compile", write=False)
    changed = {one["path"]: one for one in shown["files"] if one["status"] == "changed"}
    assert "Two farms" in changed["src/farm/flow.py"]["diff"]
    assert re.match("diff --git", changed["src/farm/flow.py"]["diff"])
    assert any("title" in sentence for sentence in shown["meaning"])
    assert {one["status"] for one in shown["files"]} == {"changed", "same"}


async def test_a_package_is_written_to_its_end_when_its_page_is_closed(tmp_path: Path) -> None:
    hooks = "def judge(trip, candidates):\n    return candidates[0]\n"
    session = Session(app_in(tmp_path, HOOKED, hooks))
    going, staying = Page(session), Page(session)
    await session.hear(going.client, '{"id": 1, "op": "compile", "write": true}')
    await asyncio.sleep(0)  # it has begun
    session.leave(going.client)
    own = tmp_path / "farm" / "src" / "farm" / "hooks.py"
    async with asyncio.timeout(60):
        while session.files.hooks_path != own:
            await asyncio.sleep(0.01)
    shown = await staying.ask("compile", write=False)
    assert (shown["known"], {one["status"] for one in shown["files"]}) == (True, {"same"})


async def test_what_compile_writes_itself_was_not_changed_elsewhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = Session(app_in(tmp_path, HOOKED))
    page = Page(session)

    def looked_at_meanwhile(app: Snapshot) -> dict[str, object]:
        answer = written(app)
        session.look()
        return answer

    monkeypatch.setattr("plutoc.editor.compiling.written", looked_at_meanwhile)
    await page.ask("compile", write=True)
    session.look()
    await page.ask("ports", source="start", when=[])  # all that was told before is here then
    assert [one["push"] for one in page.pushes] == ["hello", "change"]  # its hooks.py is there now
    (change,) = page.pushes[1:]
    assert change["file"] == "hooks" and "def judge(" in (session.files.history.hooks or "")


async def test_the_package_of_an_earlier_day_is_compared_in_meaning_too(tmp_path: Path) -> None:
    """If it is what the source says that was opened."""
    path = app_in(tmp_path)
    assert main(["compile", str(path)]) == 0
    page = Page(Session(path))
    await page.ask("edit", operation={"do": "SetTitle", "title": "Two farms"})
    assert (await page.ask("compile", write=False))["meaning"]
    path.write_text(APP.replace("The farm", "A farm"))
    page = Page(Session(path))
    assert (await page.ask("compile", write=False))["known"] is False


async def test_what_was_edited_by_hand_is_not_overwritten(tmp_path: Path) -> None:
    path = app_in(tmp_path)
    assert main(["compile", str(path)]) == 0
    flow = tmp_path / "farm" / "src" / "farm" / "flow.py"
    flow.write_text(flow.read_text() + "# by hand\n")
    page = Page(Session(path))
    await page.ask("edit", operation={"do": "SetTitle", "title": "Two farms"})
    for write in (False, True):
        assert "P4001" in (await page.ask("compile", write=write))["error"]
    assert flow.read_text().endswith("# by hand\n")


def test_a_plan_gives_what_an_action_must_be_given() -> None:
    text = APP.replace(
        "  create =",
        "  category tiny(payload: 2 g) can spray, pick_item, release_item\n"
        "  action spray(dose: mass, times: int, gently: bool, label: text, at: angle) safe\n  create =",
    )
    plan = tomllib.loads(sample_plan(Document(path="", text=text).graph))
    trips = [trip for mission in plan["mission"] for trip in mission["trip"]]
    assert {trip["action"] for trip in trips} == {"spray", "pick_item", "release_item"}
    given, *_ = (trip["parameters"] for trip in trips if trip["action"] == "spray")
    assert given == {"dose": "50 mg", "times": 3, "gently": True, "label": "text", "at": "90 deg"}
    assert {trip["item"]["mass"] for trip in trips if "item" in trip} == {0.001}
