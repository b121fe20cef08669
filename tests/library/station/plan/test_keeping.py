"""What is kept of a plan on the disk, no matter what happens to it there."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from resource import RLIMIT_FSIZE, getrlimit, setrlimit
from signal import SIG_IGN, SIGXFSZ, signal
from typing import Any

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.fields import Entity
from pluto_fleet.station.plan.plan import MissionPlan
from tests.library.files.an_app import APP
from tests.library.station.plan.drawing import FLEET, Json, a_plan, mission, trip

M = "mission-one"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "plan.json"


def missions_of(plan: MissionPlan) -> list[Json]:
    missions: Any = plan.data()["missions"]
    return list(missions)


def kept(file: Path, *missions: Json) -> MissionPlan:
    plan = a_plan(file)
    plan.replace(plan.revision, list(missions))
    return plan


def test_a_restart_finds_everything_as_it_was(file: Path) -> None:
    """Keys, order, what was launched, and what is wrong; the revision is a later one, and nobody else may read it."""
    begun = trip(target=None, item={"mass": "4 g"}, parameters={"dose": "much"})
    plan = kept(file, mission(M, safe_time="3 min"), mission("mission-two", begun, repeat=True))
    plan.launched([M])
    again = a_plan(file)
    assert again.revision > plan.revision
    assert again.trouble == ""
    assert {**again.data(), "revision": 0} == {**plan.data(), "revision": 0}
    assert file.stat().st_mode & 0o777 == 0o600
    assert [one.name for one in file.parent.iterdir()] == ["plan.json"]


def test_no_revision_ever_means_two_plans(file: Path) -> None:
    """Not even if what a page has seen could not be kept: a life counts from its clock."""
    plan = a_plan(file, now=1000.0)
    assert plan.revision == 1_000_000
    file.mkdir()  # nothing can get this name now
    plan.replace(plan.revision, [mission()])
    file.rmdir()
    assert a_plan(file, now=1001.0).revision > plan.revision
    late = kept(file, mission())
    assert a_plan(file, now=0.0).revision == late.revision + 1  # a clock may be set back


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"", "it is damaged, or is something else"),
        (b"\xff\xfe", "it is damaged, or is something else"),
        (b'{"version": 2}', "it is damaged, or is something else"),
        (b'{"version": 1, "app": "other"}', 'it is of "other", and this is alfalfa'),
        (b'{"version": 1, "app": "alfalfa"}', "it is damaged, or is something else"),
        (b'{"version": 1, "app": "alfalfa", "revision": 1, "missions": [3]}',
         "it is damaged, or is something else"),
        (b'{"version": 1, "app": "alfalfa", "revision": 1, "missions": [{}]}',
         "mission 1 has no key"),
    ],
    ids=range(7),
)  # fmt: skip
def test_what_is_no_plan_is_put_aside(file: Path, content: bytes, why: str) -> None:
    """It is said why and where; the next one finds another name."""
    for aside in ("plan.json.bad", "plan.json.bad-2"):
        file.write_bytes(content)
        plan = a_plan(file)
        assert plan.is_empty
        assert plan.trouble == (
            f"The plan that was kept cannot be read: {why}. It lies in {file.parent / aside}, "
            f"and {file} begins anew."
        )
        assert (file.parent / aside).read_bytes() == content
        assert not file.exists()
    plan.replace(plan.revision, [mission()])
    assert plan.data()["said"] == ""


@pytest.mark.parametrize("make", ["folder", "link", "pipe"])
def test_what_is_no_file_is_put_aside(file: Path, make: str) -> None:
    """A pipe is not waited for."""
    match make:
        case "folder":
            file.mkdir()
        case "link":
            file.symlink_to(file.parent / "nowhere")
        case _:
            os.mkfifo(file)
    assert "cannot be read" in a_plan(file).trouble
    assert [one.name for one in file.parent.iterdir()] == ["plan.json.bad"]


def test_what_cannot_be_put_aside_is_left_as_it_is(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Then nothing begins: it could only be written over."""

    def refuse(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    file.write_text("{")
    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(BadInput, match="cannot be put aside either: Permission denied"):
        a_plan(file)
    assert file.read_text() == "{"


def test_a_changed_app_takes_what_it_still_knows(file: Path) -> None:
    """Without the blocks that brought the fields in, they go; the plan as it was is kept, too."""
    full = mission(M, trip(delay="3 s", priority=2), safe_time="3 min", repeat=1)
    kept(file, full).launched([M])
    was = file.read_bytes()
    fields = tuple(one for one in APP.fields if one.on is Entity.MISSION and one.name != "repeat")
    plan = MissionPlan(replace(APP, fields=fields), FLEET, file)
    assert plan.trouble == (
        "The plan that was kept has repeat, delay, priority, which this app does not have any "
        f"more. The rest is here; as it was, it lies in {file}.bad."
    )
    assert (file.parent / "plan.json.bad").read_bytes() == was
    [taken] = missions_of(plan)
    assert taken["safe_time"] == "3 min"
    assert taken["launched"]
    assert not taken.keys() & {"repeat"}
    assert not taken["trips"][0].keys() & {"delay", "priority"}


@pytest.mark.skipif(sys.platform != "linux", reason="a limit on files stands for a full disk")
def test_on_a_full_disk_the_plan_lives_on_in_memory(file: Path) -> None:
    """The one before stays on the disk, and the next change is written when there is room."""
    plan = kept(file, mission())
    before = file.read_bytes()
    with full_disk():
        plan.replace(plan.revision, [mission(), mission("mission-two")])
    assert plan.trouble.startswith(f"The plan could not be written to {file}: File too large.")
    assert plan.data()["said"] == plan.trouble
    assert len(missions_of(plan)) == 2
    assert file.read_bytes() == before
    assert [one.name for one in file.parent.iterdir()] == ["plan.json"]
    plan.replace(plan.revision, [mission("mission-two")])
    assert plan.trouble == ""
    assert [one["key"] for one in json.loads(file.read_text())["missions"]] == ["mission-two"]


@contextmanager
def full_disk() -> Iterator[None]:
    """Let no file grow."""
    soft, hard = getrlimit(RLIMIT_FSIZE)
    before = signal(SIGXFSZ, SIG_IGN)
    setrlimit(RLIMIT_FSIZE, (0, hard))
    try:
        yield
    finally:
        setrlimit(RLIMIT_FSIZE, (soft, hard))
        signal(SIGXFSZ, before)


def ended(plan: MissionPlan) -> dict[str, object]:
    """Return how the missions of a plan have ended, by their names."""
    missions: Any = plan.data()["missions"]
    return {mission["name"]: mission["ended"] for mission in missions}


def flown(keep: Path | None = None) -> MissionPlan:
    """Return a plan of three missions that have flown: one failed, one was broken off."""
    plan = a_plan(keep)
    plan.replace(plan.revision, [mission(f"mission-{name}") for name in ("one", "two", "six")])
    plan.launched(["mission-one", "mission-two", "mission-six"])
    plan.settle({"mission-one": "COMPLETED", "mission-two": "FAILED", "mission-six": "BROKEN_OFF"})
    return plan


def test_a_mission_that_is_drawn_anew_has_not_been_completed_but_its_name_changes_nothing() -> None:
    plan = flown()
    one, two, six = (mission(f"mission-{name}") for name in ("one", "two", "six"))
    plan.replace(plan.revision, [{**one, "name": "First", "ended": None}, two, six])
    assert ended(plan) == {
        "First": "COMPLETED",
        "mission-two": "FAILED",
        "mission-six": "BROKEN_OFF",
    }
    more = {**one, "trips": [*one["trips"], trip("trip-more")], "ended": "COMPLETED"}
    plan.replace(plan.revision, [more, two, {**mission("mission-new"), "ended": "COMPLETED"}])
    assert ended(plan) == {"mission-one": None, "mission-two": "FAILED", "mission-new": None}


def test_how_missions_have_ended_is_kept_and_problems_of_others_hold_up_nothing(
    tmp_path: Path,
) -> None:
    flown(tmp_path / "plan.json")
    plan = a_plan(tmp_path / "plan.json")
    assert list(ended(plan).values()) == ["COMPLETED", "FAILED", "BROKEN_OFF"]
    shapes: Any = plan.data()["missions"]
    broken = {**shapes[2], "trips": [trip("trip-bad", target=[-5, 3])]}
    plan.replace(plan.revision, [*shapes[:2], broken])
    assert plan.launchable(["mission-two"])[1] == ["mission-two"]
    with pytest.raises(BadInput, match="mission-six"):
        plan.launchable()
