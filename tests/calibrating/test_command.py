"""`pluto-fleet calibrate`: what it prints and writes, and what it says of what it cannot read."""

from __future__ import annotations

import json
import os
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from shutil import copyfile

import pytest

from pluto_fleet.__main__ import main
from pluto_fleet.journal.store import Store
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from tests.calibrating.flights import surveyed

MOVES = replace(
    CRAZYFLIE, pace=1.1, settles=0.6, take_off=0.8, landing=1.2, drain=1.25, spread=0.02
)
FLEET = """# our hall
[fleet]
after_trip = "home" # always

[motion]
settles = "0.2 s"   # measured by hand
limit = 1.0
"""


@pytest.fixture(scope="module")
def journal(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("calibrating") / "J"
    return surveyed(path, MOVES, said=CRAZYFLIE, trips=60)


def calibrate(*words: object) -> int:
    return main(["calibrate", *map(str, words)])


def test_it_prints_each_value_with_its_uncertainty_and_from_what_it_was_found(
    journal: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert calibrate(journal) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "300 commands of 3 drones in 1 journal"
    assert lines[2].split() == ["said", "found", "±", "95", "%", "interval", "from"]
    assert [line.split()[0] for line in lines[3:11]] == [
        *("pace", "take_off", "settles", "landing", "spread", "action_spread", "drain", "charge")
    ]
    assert lines[3].split()[1:3] == ["100", "%"]  # what the journal's own fleet file says
    assert lines[3].endswith("120 legs")
    assert lines[4].split()[1:3] == ["0.3", "s"]


def test_programs_get_the_same_in_si_units(
    journal: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert calibrate(journal, "--json") == 0
    data = json.loads(capsys.readouterr().out)
    assert data["commands"] == 300
    assert data["journals"] == [str(journal)]
    pace = data["found"]["pace"]
    assert (pace["said"], pace["count"], pace["of"]) == (1.0, 120, "leg")
    assert pace["interval"][0] < pace["value"] < pace["interval"][1]
    assert data["found"]["drain"]["value"] == pytest.approx(1.25, abs=1e-3)
    assert data["untold"] == {}


def test_it_writes_motion_and_keeps_the_rest_of_the_file(
    journal: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "F.toml"
    file.write_bytes(FLEET.replace("\n", "\r\n").encode())
    file.chmod(0o640)
    (link := tmp_path / "link.toml").symlink_to(file)
    assert calibrate(journal, "--write", link) == 0
    out = capsys.readouterr().out.splitlines()
    text = file.read_bytes().decode()
    assert link.is_symlink()
    assert file.stat().st_mode & 0o777 == 0o640
    assert text.count("\n") == text.count("\r\n")
    lines = text.splitlines()
    assert lines[:5] == FLEET.splitlines()[:5]
    assert lines[5].startswith("settles = ")
    assert lines[5].endswith("# measured by hand")
    assert "limit = 1.0" in lines
    assert f"{link}: [motion] drain = 125 %" in out
    assert any(
        line.startswith(f"{link}: [motion] settles = ") and "(was 0.2 s)" in line for line in out
    )
    assert calibrate(journal, "--write", file) == 0
    assert capsys.readouterr().out.splitlines()[-1] == f"{file}: nothing has changed"


def test_a_fleet_file_without_motion_gets_one(journal: Path, tmp_path: Path) -> None:
    file = tmp_path / "F.toml"
    file.write_text(
        '[fleet]\napart = "1 m"\n\n[[drone]]\nid = "a"\ncategory = "c"\nhome = [1, 1]\n'
    )
    assert calibrate(journal, "--write", file) == 0
    before, after = file.read_text().split("\n[motion]\n")
    assert before.startswith('[fleet]\napart = "1 m"\n\n[[drone]]\n')
    assert 'drain = "125 %"\n' in after


def test_several_journals_count_as_one(
    journal: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = surveyed(tmp_path / "K", MOVES, said=CRAZYFLIE, trips=30, seed=5)
    assert calibrate(journal, other) == 0
    assert capsys.readouterr().out.startswith("450 commands of 3 drones in 2 journals\n")


def told(capsys: pytest.CaptureFixture[str], code: int, *words: object) -> str:
    """Run the command, which fails, and return the line that it says."""
    assert calibrate(*words) == code
    out, err = capsys.readouterr()
    assert out == ""
    return err.removesuffix("\n")


def test_what_is_no_journal_is_told_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (empty := tmp_path / "empty").touch()
    (text := tmp_path / "text").write_text(
        "no journal at all, and long enough to have a page\n" * 9
    )
    assert told(capsys, 2, tmp_path / "no") == f"{tmp_path / 'no'}: there is no such journal"
    assert told(capsys, 2, tmp_path).endswith("it is a folder: name the journal, which is a file")
    assert told(capsys, 2, empty).endswith("it is no journal, and there is nothing to read")
    assert told(capsys, 2, text).startswith(f"{text}: ")


def made(path: Path, *events: dict[str, object], **header: object) -> Path:
    """Make a journal of these events, a row each."""
    begun = {"t": 0.0, "event": "journal.begun", "app": "a", "events": 2, **header}
    with closing(Store.create(path, begun)) as store:
        store.append([json.dumps([event]) for event in events])
    return path


def test_a_journal_in_which_nothing_was_flown_is_told_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert "no drone has flown in it" in told(capsys, 2, made(tmp_path / "J"))


def test_a_measurement_of_a_later_version_is_told_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = made(tmp_path / "J", {"t": 1.0, "event": "drone.flew", "drone": "a"})
    assert told(capsys, 2, path) == (
        f"{path}: row 1 has a measurement that this pluto-fleet does not know (KeyError: 'battery'):"
        " use a newer one"
    )


def test_a_damaged_journal_is_told_so(
    journal: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    damaged = tmp_path / "J"
    copyfile(journal, damaged)
    with damaged.open("r+b") as file:
        file.seek(damaged.stat().st_size // 2)
        file.write(os.urandom(4096))
    assert "the journal is damaged" in told(capsys, 2, damaged)


def test_a_journal_that_is_named_twice_is_told_so(
    journal: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    same = journal.parent / "." / ".." / journal.parent.name / journal.name
    assert "it is named twice" in told(capsys, 2, journal, same)


def test_a_fleet_file_that_is_wrong_is_told_so(
    journal: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (bad := tmp_path / "bad.toml").write_text('[motion]\npace = "fast"\n')
    (straight := tmp_path / "straight.toml").write_text('[motion]\nlegs = "straight"\n')
    (smooth := tmp_path / "smooth.toml").write_text("")
    assert told(capsys, 2, journal, "--fleet", bad).startswith(f'{bad}:2: [motion]: pace "fast" ')
    assert told(capsys, 2, journal, "--write", tmp_path / "no.toml").startswith(f"{tmp_path}")
    differ = told(capsys, 2, journal, "--fleet", straight, "--write", smooth)
    assert differ.startswith(f"{straight} and {smooth} differ in legs of [motion]")
    assert smooth.read_text() == ""


def test_a_value_that_no_fleet_file_may_have_is_not_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Drones that are twelve times as slow as their category are no matter of calibration."""
    path = surveyed(
        tmp_path / "J", replace(MOVES, pace=12.0, drain=0.2), said=CRAZYFLIE, trips=20, drones=1
    )
    (file := tmp_path / "F.toml").write_text(FLEET)
    assert calibrate(path, "--write", file) == 2
    assert "[motion]: pace " in capsys.readouterr().err
    assert file.read_text() == FLEET


def test_too_little_to_find_anything_is_code_1(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = surveyed(tmp_path / "J", MOVES, said=CRAZYFLIE, trips=1, drones=1)
    (file := tmp_path / "F.toml").write_text(FLEET)
    assert calibrate(path, "--write", file) == 1
    assert (
        "pace cannot be told: it takes 5 legs at least, and there are 2" in capsys.readouterr().out
    )
    assert file.read_text() == FLEET
