"""`drones`: who is there, and ready; nothing of it arms or moves a drone."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from pluto_fleet.cli import drone_status
from pluto_fleet.drones import localization
from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.gateway.drone_lock import lock_drones
from tests.library.cli import fake_drones
from tests.library.cli.conftest import Command
from tests.library.cli.fake_drones import ASKED, RECORD, THERE, at
from tests.library.files.an_app import APP

FAKE = f"{fake_drones.__name__}:Fake"

FLEET = f"""
[fleet]
navigation = "{FAKE}"
[[drone]]
id = "cf1"
category = "scout"
home = [1, 1]
uri = "fake://1"
[[drone]]
id = "cf2"
category = "carrier"
home = [2, 1]
uri = "fake://silent"
[[drone]]
id = "cf3"
category = "scout"
home = [3, 1]
uri = "fake://lost"
[[drone]]
id = "cf4"
category = "scout"
home = [4, 1]
uri = "fake://4"
"""


@pytest.fixture(autouse=True)
def _drones(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    """Let some drones be there, and let those that are not there not be waited for."""
    monkeypatch.setattr(drone_status, "CONNECT_WITHIN", 0.2)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    RECORD.clear()
    THERE.clear()
    THERE["fake://1"] = at((0.52, 0.481, 0.01))
    THERE["fake://4"] = at((1.5, 2.0, 0.0), voltage=3.1)
    yield
    assert {what for _, what in RECORD} <= ASKED  # no matter what was asked, nothing has moved


@pytest.fixture
def fleet(tmp_path: Path) -> Path:
    """Four drones: one is ready, one silent, one away, one not well."""
    path = tmp_path / "fleet.toml"
    path.write_text(FLEET, encoding="utf-8")
    return path


def test_all_that_can_be_found_are_asked(command: Command) -> None:
    """Where no fleet is named, none has a name; one that is not ready makes the exit code 1."""
    code, out, err = command("drones", "--navigation", FAKE)
    assert out.splitlines() == [
        "drone  uri       firmware  decks          battery       position      ready",
        "—      fake://1  2025.02   bcLighthouse4  4.02 V, 87 %  (0.52, 0.48)  ready",
        (
            "—      fake://4  2025.02   bcLighthouse4  3.10 V, 87 %  (1.5, 2)      its battery is at 3.10 V; "
            "it lies on its back"
        ),
        "",
        "1 of 2 drones ready to fly",
    ]
    assert (code, err) == (1, "looking for drones …\nasking 2 drones …\n")


def test_the_drones_of_a_fleet_are_asked_at_once(fleet: Path, command: Command) -> None:
    """One that is silent delays no other: its row says how long it was waited for."""
    code, out, _ = command("drones", "--fleet", fleet)
    assert [line.split("  ")[0] for line in out.splitlines()[1:5]] == ["cf1", "cf2", "cf3", "cf4"]
    assert [line.split("  ")[-1].strip() for line in out.splitlines()[1:5]] == [
        "ready",
        "no answer in 0.2 s",
        "nobody is there",
        "its battery is at 3.10 V; it lies on its back",
    ]
    assert (code, out.splitlines()[-1]) == (1, "1 of 4 drones ready to fly")
    assert [uri for uri, what in RECORD if what == "close"] != []


def test_only_those_who_are_named_are_asked(fleet: Path, command: Command) -> None:
    """By their names in the fleet file, or by their uris, whether it has them or not."""
    THERE["fake://9"] = at((5.0, 5.0, 0.0))
    code, out, _ = command("drones", "cf1", "fake://9", "--fleet", fleet)
    rows = [line.split()[:2] for line in out.splitlines()[1:3]]
    assert (code, rows) == (0, [["cf1", "fake://1"], ["—", "fake://9"]])


def test_a_scan_finds_what_the_fleet_file_does_not_have(fleet: Path, command: Command) -> None:
    """The fleet's drones first, each once."""
    THERE["fake://9"] = at((5.0, 5.0, 0.0))
    _, out, _ = command("drones", "--fleet", fleet, "--scan")
    rows = [line.split()[0] for line in out.splitlines()[1:6]]
    assert rows == ["cf1", "cf2", "cf3", "cf4", "—"]


def test_another_program_gets_plain_data(fleet: Path, command: Command) -> None:
    """One object; what is not known is null."""
    _, out, _ = command("drones", "--fleet", fleet, "--json")
    data = json.loads(out)
    assert data["app"] == "alfalfa"
    assert data["drones"][0] == {
        "drone": "cf1",
        "uri": "fake://1",
        "navigation": FAKE,
        "ready": True,
        "problems": [],
        "voltage": 4.02,
        "battery_level": 0.87,
        "position": [0.52, 0.481, 0.01],
        "flying": False,
        "facts": {"firmware": "2025.02", "decks": "bcLighthouse4"},
    }
    assert [data["drones"][1][what] for what in ("position", "voltage", "ready")] == [
        None,
        None,
        False,
    ]


def test_a_drone_in_the_air_is_left_alone(fleet: Path, command: Command) -> None:
    """Its link is not closed either: for some drones that would switch the motors off."""
    THERE["fake://1"] = at((1.0, 1.0, 1.2), flying=True)
    code, out, _ = command("drones", "cf1", "--fleet", fleet)
    assert (code, "it is in the air: nothing more was asked of it" in out) == (1, True)
    assert RECORD == [("fake://1", "connect")]


def test_a_drone_that_an_app_flies_is_not_asked(fleet: Path, command: Command) -> None:
    """Two must not speak with one drone."""
    with lock_drones({"x": "fake://1"}):
        code, out, _ = command("drones", "cf1", "--fleet", fleet)
    assert (code, "is commanded by process" in out) == (1, True)
    assert ("fake://1", "connect") not in RECORD


def test_drones_are_told_where_they_are_meanwhile(
    fleet: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By the localization of the fleet file; who is not seen is not ready."""
    monkeypatch.setattr(localization, "SILENCE", -1.0)
    mocap = f'localization = "{fake_drones.__name__}:Mocap"\n[localization]\nhost = "lab"\n'
    fleet.write_text(FLEET.replace("[[drone]]", f"{mocap}[[drone]]", 1), encoding="utf-8")
    code, out, _ = command("drones", "cf1", "cf4", "--fleet", fleet)
    assert ("fake://1", "locate") in RECORD
    assert ("fake://4", "locate") not in RECORD
    assert (code, f"no position from {fake_drones.__name__}:Mocap" in out) == (1, True)


def test_a_mistake_of_a_navigation_is_one_rows(fleet: Path, command: Command) -> None:
    """The others are asked all the same; there is no traceback, and nothing for the terminal."""
    code, out, err = command("drones", "cf1", "fake://wrong", "--fleet", fleet)
    assert "its navigation made a mistake: TypeError: not a \\x1b[2Jfloat" in out
    assert (code, "Traceback" in err, out.splitlines()[1].endswith("ready")) == (1, False, True)


def test_one_drone_shows_which_it_is(fleet: Path, command: Command) -> None:
    """By its name or its uri; nothing else is asked of it."""
    said = "cf1 (fake://1) has shown itself\n"
    assert command("drones", "--fleet", fleet, "--identify", "cf1") == (0, said, "")
    assert [("fake://1", what) for what in ("connect", "identify", "close")] == RECORD
    said = "fake://1 has shown itself\n"
    assert command("drones", "--navigation", FAKE, "--identify", "fake://1") == (0, said, "")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--identify cf33 --fleet F", 'the fleet has no drone "cf33"; did you mean "cf3"?'),
        ("--identify cf2 --fleet F", "cf2: no answer in 0.2 s"),
        ("--identify cf3 --fleet F", "cf3: nobody is there"),
        ("cf1", 'which drone is "cf1"? Name its uri, or the --fleet it is of'),
        ("--scan", "--scan goes with --fleet, and with no drone: drones alone finds all"),
        ("cf1 --fleet F --identify cf1", "--identify names the drone itself: leave the others out"),
    ],
)
def test_what_cannot_be_is_refused(fleet: Path, command: Command, words: str, said: str) -> None:
    """In a line, with exit code 2."""
    argv = ["drones", *(str(fleet) if word == "F" else word for word in words.split())]
    assert command(*argv) == (2, "", f"{said}\n")


def test_one_that_can_do_no_more_than_fly_is_asked_all_the_same(command: Command) -> None:
    """But it cannot be found, and has nothing by which to show itself."""
    plain = f"{fake_drones.__name__}:Bare"
    assert command("drones", "fake://1", "--navigation", plain)[0] == 0
    code, _, err = command("drones", "--identify", "fake://1", "--navigation", plain)
    assert (code, err) == (2, "fake://1 has nothing by which it could show itself\n")
    code, _, err = command("drones", "--navigation", plain)
    assert code == 2
    assert err.endswith("cannot look for drones: name them, or their fleet file with --fleet\n")


def test_a_missing_dongle_is_no_traceback(fleet: Path, command: Command) -> None:
    """What the navigation says of it is said."""
    text = FLEET.replace("[[drone]]", f'[navigation."{FAKE}"]\ndongle = "none"\n[[drone]]', 1)
    fleet.write_text(text, encoding="utf-8")
    code, out, err = command("drones", "--fleet", fleet, "--scan")
    said = "cannot look for drones: there is no Crazyradio: plug one in\n"
    assert (code, out, err) == (2, "", f"looking for drones …\n{said}")


def test_a_fleet_file_is_made_of_those_that_answer(tmp_path: Path, command: Command) -> None:
    """Homes are where they stand, or in a row; categories in turn; the app can read it."""
    THERE["fake://5"] = at((-0.3, 1.0, 0.0))
    THERE["fake://6"] = at((1.5, 2.1, 0.0))
    THERE["fake://7"] = at((0.01, 0.0, 0.0))
    path = tmp_path / "new.toml"
    code, _, err = command("drones", "--navigation", FAKE, "--save", path)
    assert code == 1  # one of them is not ready
    assert err.endswith(f"{path}: 5 drones; look at each home before anything flies\n")
    fleet = load_fleet(path, APP)
    assert fleet.navigation == FAKE
    assert [(one.id, one.category, one.home, one.uri) for one in fleet.drones] == [
        ("cf1", "scout", (0.52, 0.48, 0.0), "fake://1"),
        ("cf2", "carrier", (1.5, 2.0, 0.0), "fake://4"),
        ("cf3", "scout", (2.0, 0.5, 0.0), "fake://5"),
        ("cf4", "carrier", (3.0, 0.5, 0.0), "fake://6"),
        ("cf5", "scout", (4.0, 0.5, 0.0), "fake://7"),
    ]
    assert "home = [2.0, 0.5]  # put it there: it said (-0.3, 1)" in path.read_text("utf-8")


def test_no_file_is_overwritten(fleet: Path, command: Command) -> None:
    """Not even looked at: it is said before any drone is asked."""
    code, _, err = command("drones", "--navigation", FAKE, "--save", fleet)
    assert (code, err) == (
        2,
        f"{fleet}: there is such a file already, and it is never overwritten\n",
    )
    assert RECORD == []


def test_nothing_is_saved_where_no_drone_answers(tmp_path: Path, command: Command) -> None:
    """A fleet of none cannot fly."""
    THERE.clear()
    path = tmp_path / "new.toml"
    code, out, err = command("drones", "--navigation", FAKE, "--save", path)
    assert (code, path.exists()) == (2, False)
    assert out == "no drone answers: are they switched on, and near?\n"
    assert err.endswith("not written, for no drone has answered\n")
