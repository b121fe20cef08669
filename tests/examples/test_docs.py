"""What the pages show is true: apps compile, pieces of them parse, and hooks fly."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.files.fleet import default_fleet
from pluto_fleet.shared.alone.world import Faults
from plutoc import registry
from plutoc.cli import main
from plutoc.source import Source
from plutoc.syntax.parse import parse
from tests.kit.apps import fly, loaded
from tests.paths import ROOT

DOCS = ROOT / "docs"
PAGES = sorted([DOCS / "language.md", *DOCS.glob("tutorial/*.md")])
FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks(page: Path, language: str) -> list[str]:
    """Return a page's fenced blocks in a language."""
    return [text for found, text in FENCE.findall(page.read_text("utf-8")) if found == language]


def whole(text: str) -> str:
    """Return a piece of an app as a file: the grammar knows no less."""
    return text if text.startswith("pluto 1") else f"pluto 1\napp page {{\n{text}}}\n"


PIECES = [(page.name, text) for page in PAGES for text in blocks(page, "pluto")]


@pytest.mark.parametrize(("page", "text"), PIECES, ids=[page for page, _ in PIECES])
def test_every_piece_of_an_app_is_in_the_language(page: str, text: str) -> None:
    """Whole apps and pieces of them parse."""
    parse(Source(page, whole(text)))


def test_first_app_of_the_language_page_is_sound(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What a reader sees first has no errors and no warnings."""
    (tmp_path / "app.pluto").write_text(blocks(DOCS / "language.md", "pluto")[0], "utf-8")
    assert main(["check", str(tmp_path / "app.pluto")]) == 0
    assert "warning" not in capsys.readouterr().err


def test_language_page_has_every_block_with_its_fields() -> None:
    """The table has a line for each standard kind, and in it the statuses and fields it declares."""
    text = (DOCS / "language.md").read_text("utf-8")
    for kind, block in registry.blocks_of("std").items():
        (row,) = re.findall(rf"^\| `{kind}` \|.*$", text, re.MULTILINE)
        fields = row.split("|")[-2]
        assert re.findall(r"`(\w+)`", fields) == [field.name for field in block.needs], kind
        for param in block.params:
            assert f"`{param.name}`" in row, kind


def test_missing_arrow_of_the_tutorial_is_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without the arrow back a mission is stuck, and the compiler says which way leads there."""
    monkeypatch.chdir(tmp_path)
    assert main(["new", "my_app"]) == 0
    app = tmp_path / "my_app" / "my_app.pluto"
    line = "first -> allocate when STANDBY"
    assert app.read_text("utf-8").count(line) == 1
    app.write_text(app.read_text("utf-8").replace(line, f"# {line}"), "utf-8")
    capsys.readouterr()
    assert main(["check", str(app)]) == 1
    said = capsys.readouterr().err
    assert "leaves `first` STANDBY is stuck" in said
    assert (
        "create (UNEXECUTED) → allocate (UNEXECUTED) → launch (RUNNING) → watch (STANDBY)" in said
    )


def test_a_trip_is_put_back_as_the_reference_says() -> None:
    """The reference's `once_more` lets a failed trip fly twice, and no more often."""
    code, graph = with_name("once_more", "python"), with_name("once_more", "pluto")
    text = (
        "pluto 1\napp NAME {\n"
        "create = MissionCreator\nallocate = DroneAllocator\nlaunch = TripLauncher\n"
        "watch = TripMonitor\nstart -> create -> allocate -> launch -> watch\n"
        f"watch -> allocate when STANDBY\nwatch -> end when COMPLETED\n{graph}}}\n"
    )
    app = loaded(text, f"from . import Context, Mission, Status\n\n\n{code}").app
    trip = app.trip(name="A", action="measure", target=(2, 2, 1))
    made: Any = app.mission(name="m", trips=[trip])
    outcome = fly(app, made, on=default_fleet(app), faults=Faults(action=1.0))
    (mission,) = outcome.missions
    assert (mission.status.value, mission.attempts) == ("FAILED", 2)
    assert outcome.log[0].startswith("A is tried again: measure failed")


def with_name(name: str, language: str) -> str:
    """Return the block of the reference that declares a hook."""
    pattern = re.compile(rf"^(def|modifier) {name}\b", re.MULTILINE)
    return next(
        text for text in blocks(DOCS / "tutorial/hooks.md", language) if pattern.search(text)
    )


def test_reference_lists_what_trips_missions_and_drones_offer() -> None:
    """Every public attribute of the three stands on the page."""
    from pluto_fleet.shared.domain.model import Drone, Mission, Trip

    text = (DOCS / "tutorial/hooks.md").read_text("utf-8")
    # what the runtime needs of them, and hooks do not
    inner = {"index", "last_result", "now", "number", "promises", "rank", "telemetry"}
    for kind in (Mission, Trip, Drone):
        names = {name for name in dir(kind) if not name.startswith("_")} - inner
        missing = sorted(name for name in names if not re.search(rf"`{name}[`(]", text))
        assert not missing, f"{kind.__name__}: {missing}"
