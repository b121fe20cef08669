"""What is saved, what others change meanwhile, and what must never be written."""

from __future__ import annotations

import errno
import os
from pathlib import Path
from typing import Any

import pytest

from plutoc.editor.disk import ChangedOutside, Kept
from plutoc.editor.history import File
from plutoc.editor.session import Session
from plutoc.project.reading import UsageError

from .editing import APP, HOOKED, Page, app_in, files_of, working


def written_by_others(path: Path, text: str) -> None:
    """Write as another editor does: beside, and renamed."""
    aside = path.with_name(f"{path.name}.other")
    aside.write_bytes(text.encode())
    aside.replace(path)


@pytest.fixture(autouse=True)
def soon(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is waited for that need not be."""
    for name in ("SAVE_AFTER", "LOOK_EVERY", "AGAIN_AFTER"):
        monkeypatch.setattr(f"plutoc.editor.session.{name}", 0.01)


async def test_what_is_changed_is_saved_and_undone_to_the_same_bytes(tmp_path: Path) -> None:
    """Line ends of both kinds, a byte order mark, a layout that another program wrote."""
    text = "\ufeff" + HOOKED.replace("\n", "\r\n", 5)
    path = app_in(tmp_path, text, "def judge(trip, candidates):\r\n    return 1\n")
    (tmp_path / "farm.pluto.layout").write_bytes(b"watch  8   8\r\n\xff junk\nallocate 1 2")
    path.chmod(0o640)
    before = files_of(tmp_path)
    session = Session(path)
    page = Page(session)

    async with working(session):
        await page.type(0, "# hi\n")
        await page.ask("edit", operation={"do": "Rename", "name": "judge", "new": "decide"})
        await page.ask("place", positions={"launch": [80, 40]})
        await page.saved()
        assert files_of(tmp_path).keys() == before.keys()
        assert (
            tmp_path / "farm.pluto.layout"
        ).read_text() == "allocate 1 2\nlaunch 80 40\nwatch 8 8\n"
        assert b"policy decide" in path.read_bytes()
        assert b"def decide(" in (tmp_path / "hooks.py").read_bytes()
        for _ in range(3):
            await page.ask("undo")
        await page.saved()
    assert files_of(tmp_path) == before
    assert path.stat().st_mode & 0o777 == 0o640


async def test_to_look_at_an_app_writes_nothing(tmp_path: Path) -> None:
    session = Session(tmp_path / "new.pluto")
    page = Page(session)

    async with working(session):
        await page.ask("ports", source="start", when=[])
        await page.ask("format")
        session.look()
        session.save()
        assert files_of(tmp_path) == {}
        await page.type(0, "# first\n")
        await page.told("disk", what="saved")
    assert files_of(tmp_path) == {"new.pluto": b"# first\npluto 1\n\napp new {\n}\n"}


async def test_what_others_write_is_taken_in_and_can_be_undone(tmp_path: Path) -> None:
    path = app_in(tmp_path)
    session = Session(path)
    page = Page(session)

    async with working(session):
        written_by_others(path, APP.replace("A farm", "A field"))
        push = await page.told("change")
        assert push["by"] == 0
        assert push["changes"] == [
            {"from": APP.index("arm."), "to": APP.index("arm.") + 3, "insert": "ield"}
        ]
        await page.told("disk", what="merged")
        await page.ask("undo")
        await page.told("disk", what="saved")
    assert path.read_text() == APP


async def test_changes_of_both_are_put_together_where_the_statements_differ(tmp_path: Path) -> None:
    path = app_in(tmp_path)
    session = Session(path)
    page = Page(session)
    await page.type(APP.index("The farm"), "My farm", APP.index("The farm") + 8)
    written_by_others(path, APP.replace("launch = ", "go = ").replace("launch", "go"))

    async with working(session):
        await page.told("disk", what="merged")
        await page.saved()
    assert path.read_text() == APP.replace("launch", "go").replace("The farm", "My farm")


@pytest.mark.parametrize("keep", ["ours", "theirs"])
async def test_the_same_statement_is_for_a_person_to_decide(tmp_path: Path, keep: str) -> None:
    """Until then nothing is overwritten; what is not kept can be had back."""
    path = app_in(tmp_path)
    session = Session(path)
    page = Page(session)
    place = APP.index("The farm")
    await page.type(place, "My farm", place + 8)
    ours, theirs = APP.replace("The farm", "My farm"), APP.replace("The farm", "Your farm")
    written_by_others(path, theirs)

    async with working(session):
        push = await page.told("disk", what="conflict", file="app")
        assert (push["ours"], push["theirs"]) == (ours, theirs)
        assert session.lost
        assert "decide first" in (await page.ask("compile", write=True))["error"]
        await page.type(0, "# more\n")
        session.save()
        assert path.read_text() == theirs
        again = Page(session)
        await again.told("disk", what="conflict")
        assert "error" not in await page.ask("resolve", keep=keep)
        await again.told("disk", what="resolved")
        await page.saved()
        assert path.read_text() == (f"# more\n{ours}" if keep == "ours" else theirs)
        await page.ask("undo")
        assert session.files.history.app == (ours if keep == "ours" else f"# more\n{ours}")


async def test_a_file_that_is_removed_is_kept_in_memory_and_written_with_the_next_change(
    tmp_path: Path,
) -> None:
    path = app_in(tmp_path)
    session = Session(path)
    page = Page(session)

    async with working(session):
        path.unlink()
        await page.told("disk", what="gone")
        session.save()
        assert not path.exists()
        await page.type(0, "# hi\n")
        await page.told("disk", what="saved")
        assert path.read_text() == f"# hi\n{APP}"
        path.unlink()  # as a checkout of another branch does
        await page.told("disk", what="gone")
        written_by_others(path, APP)
        await page.told("disk", what="merged")
        assert session.files.history.app == APP


async def test_hooks_that_others_write_appear(tmp_path: Path) -> None:
    session = Session(app_in(tmp_path, HOOKED))
    page = Page(session)

    async with working(session):
        (tmp_path / "hooks.py").write_text(
            "def judge(trip, candidates):\n    return candidates[0]\n"
        )
        push = await page.told("change", file="hooks")
        assert push["view"]["hooks"][0]["defined"] is True


async def test_what_is_no_text_any_more_is_not_overwritten_unasked(tmp_path: Path) -> None:
    path = app_in(tmp_path)
    session = Session(path)
    page = Page(session)

    async with working(session):
        path.write_bytes(b"app \xff")
        push = await page.told("disk", what="conflict")
        assert push["theirs"] is None
        assert "not UTF-8" in push["why"]
        await page.type(0, "# hi\n")
        session.save()
        assert path.read_bytes() == b"app \xff"
        assert "not UTF-8" in (await page.ask("resolve", keep="theirs"))["error"]
        await page.ask("resolve", keep="ours")
        await page.told("disk", what="saved")
        assert path.read_text() == f"# hi\n{APP}"


@pytest.mark.parametrize("name", ["farm.pluto", "farm.pluto.layout", "hooks.py"])
async def test_nothing_is_written_through_a_link(tmp_path: Path, name: str) -> None:
    """One that comes in a file's place leads to a file that stays as it is."""
    session = Session(app_in(tmp_path, HOOKED, "def judge(trip, candidates):\n    return 1\n"))
    page = Page(session)
    secret = tmp_path / "secret"
    secret.write_text("mine")

    async with working(session):
        (tmp_path / name).unlink(missing_ok=True)
        (tmp_path / name).symlink_to(secret)
        await page.type(0, "# hi\n")
        await page.type(0, "# hi\n", file="hooks")
        await page.ask("place", positions={"watch": [1, 2]})
        await page.told(*(("cannot_save",) if name.endswith("layout") else ("disk",)))
    assert secret.read_text() == "mine"
    assert (tmp_path / name).is_symlink()


async def test_a_package_that_is_a_link_is_not_edited_through(tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    (elsewhere / "farm").mkdir(parents=True)
    (elsewhere / "farm" / "hooks.py").write_text("")
    (tmp_path / "farm").mkdir()
    (tmp_path / "farm" / "src").symlink_to(elsewhere)
    with pytest.raises(UsageError, match="symbolic link"):
        Session(app_in(tmp_path, HOOKED))


async def test_a_full_disk_is_told_and_nothing_is_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = app_in(tmp_path)
    session = Session(path)
    page = Page(session)
    full, fsync = [True], os.fsync

    def refused(descriptor: int) -> None:
        if full[0]:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        fsync(descriptor)

    monkeypatch.setattr(os, "fsync", refused)

    async with working(session):
        await page.type(0, "# hi\n")
        push = await page.told("cannot_save")
        assert "No space left" in push["why"]
        assert session.lost == push["why"]
        assert files_of(tmp_path) == {"farm.pluto": APP.encode()}
        late = Page(session)
        await late.told("cannot_save")
        await page.type(0, "# and more\n")
        full[0] = False
        await page.told("disk", what="saved")
    assert path.read_text() == f"# and more\n# hi\n{APP}"
    assert not session.lost


def test_what_others_write_while_it_is_saved_is_noticed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Even if it comes right behind the renaming."""
    path = tmp_path / "a"
    path.write_bytes(b"one")
    kept = Kept(path)
    kept.read()
    replace = os.replace

    def replaced(*paths: Any) -> None:
        replace(*paths)
        path.write_bytes(b"their")

    monkeypatch.setattr(os, "replace", replaced)
    kept.save(b"twoo!")
    monkeypatch.undo()
    assert kept.is_changed()
    with pytest.raises(ChangedOutside):
        kept.save(b"three")
    assert path.read_bytes() == b"their"


async def test_positions_that_others_move_are_taken_but_for_those_moved_here(
    tmp_path: Path,
) -> None:
    layout = tmp_path / "farm.pluto.layout"
    session = Session(app_in(tmp_path))
    page = Page(session)
    await page.ask("place", positions={"watch": [1, 1], "launch": [2, 2]})
    session.save()
    await page.ask("place", positions={"watch": [3, 3]})
    layout.write_text("allocate 7 7\nlaunch 8 8\nwatch 9 9\n")
    session.look()
    assert dict(session.files.history.positions) == {
        "allocate": (7, 7),
        "launch": (8, 8),
        "watch": (3, 3),
    }
    layout.unlink()
    session.look()
    assert File.LAYOUT in session.files.unsaved
    assert dict(session.files.history.positions) == {"watch": (3, 3)}
