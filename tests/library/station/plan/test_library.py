"""Plans that are kept under names, as files that `fly` reads."""

from __future__ import annotations

from itertools import count
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.files.missions import load_missions
from pluto_fleet.files.reading import LARGEST
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.plan import kept
from pluto_fleet.station.plan.kept import PlanLibrary
from pluto_fleet.station.plan.plan import MissionPlan, Stale
from tests.library.files.an_app import APP
from tests.library.station.plan.drawing import FLEET, drawn, mission, trip


def library(folder: Path, plan: MissionPlan | None = None) -> PlanLibrary:
    """Return the library of a folder; its clock goes on by a second each time it is asked."""
    seconds = count(1)
    plan = plan or drawn()
    return PlanLibrary(folder / "plans", plan.saved, now=lambda: float(next(seconds)))


def save(shelf: PlanLibrary, name: str, plan: MissionPlan, replace: bool = False) -> None:
    shelf.save(name, plan.export_toml(), "Ada\x7f", template=name == "Row", replace=replace)


def names(plan: MissionPlan) -> list[object]:
    missions: Any = plan.data()["missions"]
    return [one["name"] for one in missions]


def test_a_plan_is_a_missions_file(tmp_path: Path) -> None:
    """And is listed with who kept it, and what it has."""
    plan, shelf = drawn(mission("mission-one"), mission("mission-two")), library(tmp_path)
    assert (shelf.plans(), shelf.trash()) == ([], [])
    save(shelf, "Montag früh", plan)
    save(shelf, "Row", plan)
    file = tmp_path / "plans" / "Montag früh.toml"
    assert [one.name for one in load_missions(file, APP, FLEET.airspace)] == names(plan)
    one, row = sorted(shelf.plans(), key=lambda one: one["name"])
    assert one == {
        "name": "Montag früh",
        "saved_at": file.stat().st_mtime_ns // 1_000_000,
        "by": "Ada\\x7f",
        "missions": 2,
        "template": False,
        "said": "",
    }
    assert row["template"] is True
    assert file.stat().st_mode & 0o077 == 0


NO_NAMES = ("", " ", "../x", "a\\b", ".hidden", "a\0", "a\n", "C:", 81 * "x", 150 * "é")


@pytest.mark.parametrize("name", NO_NAMES)
def test_a_name_is_no_path(tmp_path: Path, name: str) -> None:
    """For nothing that can be done with it."""
    shelf = library(tmp_path)
    for do in (shelf.text, shelf.delete, lambda name: save(shelf, name, drawn(mission()))):
        with pytest.raises(BadInput):
            do(name)
    assert list(tmp_path.iterdir()) == []


def test_links_and_folders_are_no_plans(tmp_path: Path) -> None:
    """What lies elsewhere is not read."""
    (tmp_path / "plans" / "folder.toml").mkdir(parents=True)
    (tmp_path / "secret").write_text("x")
    (tmp_path / "plans" / "link.toml").symlink_to(tmp_path / "secret")
    shelf = library(tmp_path)
    assert shelf.plans() == []
    for name in ("folder", "link"):
        with pytest.raises(BadInput, match="there is no plan"):
            shelf.text(name)


def test_what_is_deleted_or_replaced_can_be_restored(tmp_path: Path) -> None:
    """Under its name, when that is free."""
    shelf = library(tmp_path)
    save(shelf, "A", drawn(mission(name="old")))
    with pytest.raises(BadInput, match='there is a plan "A" already'):
        save(shelf, "A", drawn(mission(name="new")))
    save(shelf, "A", drawn(mission(name="new")), replace=True)
    [old] = shelf.trash()
    with pytest.raises(BadInput, match='there is a plan "A" again'):
        shelf.restore(old["id"])
    shelf.delete("A")
    assert [one["name"] for one in shelf.trash()] == ["A", "A"]
    shelf.restore(old["id"])
    assert '"old"' in shelf.text("A")
    for id in (old["id"], "../A", ""):
        with pytest.raises(BadInput, match="not in the trash"):
            shelf.restore(id)


def test_the_trash_forgets_the_oldest(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept, "MOST_IN_TRASH", 2)
    shelf = library(tmp_path)
    for name in ("A", "B", "C"):
        save(shelf, name, drawn(mission()))
        shelf.delete(name)
    assert [one["name"] for one in shelf.trash()] == ["C", "B"]


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"\xff", "Bad.toml:1: is not UTF-8 text"),
        (b"#" * (LARGEST + 1), "is larger than 1024 KiB"),
        (b'{"fileType": "Plan"}', "Bad.toml: is a plan of QGroundControl, and not TOML"),
        (b"[map]", "is no plan"),
        (b"mission = [3]", "mission 1 is none"),
        (b"[[mission]]\nspeed = 3", 'unknown key "speed"'),
    ],
)
def test_what_cannot_be_read_is_listed_with_why(tmp_path: Path, content: bytes, said: str) -> None:
    """Beside the others."""
    plan = drawn(mission())
    shelf = library(tmp_path, plan)
    save(shelf, "Good", plan)
    marked = b"\xef\xbb\xbf" + (tmp_path / "plans" / "Good.toml").read_bytes()
    (tmp_path / "plans" / "Good.toml").write_bytes(marked)  # as some editors write it
    (tmp_path / "plans" / "Bad.toml").write_bytes(content)
    bad, good = sorted(shelf.plans(), key=lambda one: one["name"])
    assert bad["missions"] is None and said in bad["said"]
    assert (good["missions"], good["said"], good["by"]) == (1, "", "Ada\\x7f")


def test_an_unfinished_plan_comes_back_as_it_was_drawn(tmp_path: Path) -> None:
    """It is told what is still to be done; a file that flies needs all of it."""
    begun = mission(
        "mission-one",
        trip(target=None, item={}),
        name="",
        safe_time="3 m",
        opens="08:00",
        deadline="",
        after=["x"],
    )
    plan = drawn(begun, mission("mission-two", trips=[]))
    shelf = library(tmp_path, plan)
    save(shelf, "Begun", plan)
    [one] = shelf.plans()
    assert one["missions"] == 2 and 'safe_time "3 m" is a length' in one["said"]
    again = drawn()
    again.take_instead(again.saved(shelf.text("Begun"), "Begun")[0], again.revision)
    assert again.export_toml() == plan.export_toml()


def test_a_plan_is_added_under_names_that_are_free(tmp_path: Path) -> None:
    """What comes after another comes after the one that was added with it."""
    plan = drawn(mission("mission-one", name="A"), mission("mission-two", name="B", after=["A"]))
    shapes, said = plan.saved(plan.export_toml(), "x")
    assert said == ""
    plan.add(shapes, plan.revision)
    plan.add(shapes, plan.revision)
    assert names(plan) == ["A", "B", "A 2", "B 2", "A 3", "B 3"]
    missions: Any = plan.data()["missions"]
    assert [one.get("after") for one in missions[3::2]] == [["A 2"], ["A 3"]]
    with pytest.raises(Stale):
        plan.add(shapes, plan.revision - 1)
