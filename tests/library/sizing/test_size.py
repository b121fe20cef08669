"""The command `size`: what it says, writes and draws, and what it refuses."""

from __future__ import annotations

import re
import shutil
from collections.abc import Sequence
from pathlib import Path

import pytest

from pluto_fleet.app import App
from pluto_fleet.cli import main
from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.shared.domain.model import Category
from tests.kit.apps import app, flow
from tests.kit.command import Program, run
from tests.kit.session import check_session, sessions

HERE = Path(__file__).parent / "sessions"
TESTED = app(flow(clock=True), categories=[Category(name="scout")])
SHORT = app(flow(), categories=[Category(name="scout", flight_time=100.0, charge_time=900.0)])


def sizes(tested: App) -> Program:
    """Return the command of an app, with confidence 80 %, which few runs show."""

    def size(words: Sequence[str]) -> int:
        return main(tested, ["size", "--confidence", "80%", *words])

    return size


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    """Three missions of a photo each, all half a minute away, and one drone."""
    for name in ("m.toml", "fleet.toml"):
        shutil.copy(HERE / name, tmp_path)
    return tmp_path / "m.toml"


@pytest.mark.parametrize("session", sessions(HERE))
def test_what_is_typed_prints_what_is_written(session: Path, update: bool, tmp_path: Path) -> None:
    """With the exit codes, and the files that come of it."""
    programs = {"size": sizes(TESTED), "short": sizes(SHORT)}
    check_session(session, programs, update, tmp_path, without_usage)


def without_usage(text: str) -> str:
    """Leave out the usage, which each version of Python folds in its own way."""
    return re.sub(r"usage: (.*\n)+?(?=.*: error: )", "", text)


@pytest.mark.process
def test_the_answer_and_its_picture_are_the_same_for_any_number_of_jobs(plan: Path) -> None:
    """With mishaps, to the byte."""
    pytest.importorskip("matplotlib")
    picture, came = plan.with_name("picture.svg"), []
    for jobs in (1, 3):
        flags = ("--by", "3 min", "--fail", "crash=3%", "--json", "--plot", picture)
        came.append((run(sizes(TESTED), plan, *flags, "--jobs", jobs), picture.read_bytes()))
        picture.unlink()
    assert came[0] == came[1]
    ran, drawn = came[0]
    assert ran.code == 0 and drawn.startswith(b"<?xml")


def test_the_fleet_that_is_written_can_be_flown(plan: Path) -> None:
    path = plan.with_name("new.toml")
    assert run(sizes(TESTED), plan, "--by", "50 s", "--write", path).code == 0
    written = load_fleet(path, TESTED)
    assert [drone.id for drone in written.drones] == ["cf1", "scout2", "scout3"]
    assert not written.motion.smooth
