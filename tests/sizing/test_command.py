"""The command `size`: what it says, writes and draws, and what it refuses."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from pluto_fleet.app import App
from pluto_fleet.cli import main
from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.shared.domain.model import Category
from tests.kit.apps import app, flow

TESTED = app(flow(clock=True), categories=[Category(name="scout")])
FLEET = """
[motion]
legs = "straight"
[fleet]
after_trip = "home"
apart = 0
[[drone]]
id = "cf1"
home = [1.0, 0.5]
"""


Said = Callable[..., tuple[int, str, str]]


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    """Three missions of a photo each, all half a minute away, and one drone."""
    missions = [
        f'[[mission]]\nname = "M{n}"\n[[mission.trip]]\naction = "take_photo"\ntarget = [15, {n}]\n'
        for n in (1, 2, 3)
    ]
    (tmp_path / "fleet.toml").write_text(FLEET)
    path = tmp_path / "m.toml"
    path.write_text("\n".join(missions))
    return path


@pytest.fixture
def said(capsys: pytest.CaptureFixture[str]) -> Said:
    """Run `size` with confidence 80 %, which few runs show."""

    def run(*argv: object, tested: App = TESTED) -> tuple[int, str, str]:
        words: Sequence[str] = ["size", "--confidence", "80%", *map(str, argv)]
        code = main(tested, words)
        out, err = capsys.readouterr()
        return code, out, err

    return run


def test_the_answer_says_how_many_and_which_are_to_be_added(plan: Path, said: Said) -> None:
    """With the fleets that were flown, and why one fewer is too few."""
    code, out, err = said(plan, "--by", "50 s")
    assert code == 0
    assert err == f"fleet: {plan.parent}/fleet.toml, beside the missions; or name one: --fleet\n"
    table, answer, which, *new = out.split("\n\n")
    assert table.splitlines() == [
        "drones    runs  succeeded  at least  at most",
        "1 drone     20          0       0 %   11.9 %",
        "2 drones    20          0       0 %   11.9 %",
        "3 drones    22         22    89.0 %    100 %",
        "4 drones    22         22    89.0 %    100 %",
    ]
    assert answer.splitlines() == [
        "3 drones complete all 3 missions within 50 s in 80 % of runs or more",
        "22 of 22 simulated runs succeeded: 89.0 % or more, with 95 % certainty",
        'one fewer: 20 of 20 runs: mission "M3" is not completed within 50 s',
    ]
    assert which.splitlines() == ["of the fleet file: cf1", "to be added to it:"]
    assert new == [
        '[[drone]]\nid = "scout2"\ncategory = "scout"\nhome = [2, 0.5]',
        '[[drone]]\nid = "scout3"\ncategory = "scout"\nhome = [1, 1.5]\n',
    ]


def test_the_answer_is_the_same_for_any_number_of_jobs(plan: Path, said: Said) -> None:
    """With mishaps, to the byte."""
    flags = (plan, "--by", "3 min", "--fail", "crash=3%", "--json")
    assert said(*flags, "--jobs", 1) == said(*flags, "--jobs", 3)


def test_the_fleet_is_written_into_a_new_file(plan: Path, said: Said) -> None:
    """One that can be flown; never over another."""
    path = plan.with_name("new.toml")
    assert said(plan, "--by", "50 s", "--write", path)[0] == 0
    written = load_fleet(path, TESTED)
    assert [drone.id for drone in written.drones] == ["cf1", "scout2", "scout3"]
    assert not written.motion.smooth
    code, out, err = said(plan, "--write", path)
    assert (code, out) == (2, "")
    assert f"{path}: it is there already, and is not replaced\n" in err


def test_a_program_gets_it_all(plan: Path, said: Said) -> None:
    """The fleet, what was tried, and why."""
    code, out, _ = said(plan, "--by", "50 s", "--json")
    data = json.loads(out)
    assert code == 0
    assert data["drones"] == {"scout": 3}
    assert [(one["id"], one["new"]) for one in data["fleet"]] == [
        ("cf1", False),
        ("scout2", True),
        ("scout3", True),
    ]
    assert [one["verdict"] for one in data["tried"]] == [
        "refused",
        "refused",
        "promised",
        "promised",
    ]
    assert (data["within_s"], data["confidence"], data["found"]) == (50.0, 0.8, True)


def test_where_there_is_none_the_cause_is_told_and_it_is_exit_1(plan: Path, said: Said) -> None:
    """In words."""
    code, out, _ = said(plan, "--by", "20 s")
    assert code == 1
    assert out.split("\n\n")[1] == (
        "no fleet is sure to complete all 3 missions within 20 s in 80 % of runs:\n"
        '  mission "M1" takes 25 s even if it has 16 drones for itself and nothing goes wrong: more'
        " than 20 s\n"
    )


def test_swapped_batteries_are_counted(plan: Path, said: Said) -> None:
    """So many spare ones that a full one is always at hand; without them it takes more drones."""
    short = app(flow(), categories=[Category(name="scout", flight_time=100.0, charge_time=900.0)])
    code, out, _ = said(plan, "--by", "6 min", tested=short)
    assert code == 0
    assert "3 drones complete all 3 missions" in out
    assert (
        "with batteries swapped in 1 min instead of charged, 1 drone would do (--swap 1min)" in out
    )
    code, out, _ = said(plan, "--by", "6 min", "--swap", "1min", tested=short)
    assert code == 0
    assert "1 drone completes all 3 missions" in out
    assert "3 spare batteries and as many chargers (3 for scout)" in out


def test_a_time_of_day_is_for_missions_that_begin_at_one(plan: Path, said: Said) -> None:
    """It counts from the first of them."""
    code, _, err = said(plan, "--by", "08:30")
    assert code == 2
    assert "--by 08:30 is a time of day, and not all missions begin at one" in err
    times = {1: "08:00", 2: "08:00", 3: "08:01"}
    text = plan.read_text()
    for number, at in times.items():
        text = text.replace(f'name = "M{number}"', f'name = "M{number}"\nat = "{at}"')
    plan.write_text(text)
    code, out, _ = said(plan, "--by", "08:02")
    assert code == 0
    assert "2 drones complete all 3 missions within 2 min" in out


def test_so_it_is_where_windows_open(plan: Path, said: Said) -> None:
    """At a time of day: in a simulation, which begins at midnight, that is hours later."""
    text = plan.read_text()
    for number, opens in {1: "08:00", 2: "08:01", 3: "08:00"}.items():
        window = f'window = ["{opens}", "09:00"]'
        text = text.replace(f'name = "M{number}"', f'name = "M{number}"\n{window}')
    plan.write_text(text)
    assert said(plan, "--by", "2 min")[:2] == said(plan, "--by", "08:02")[:2]
    assert "2 drones complete all 3 missions within 2 min" in said(plan, "--by", "08:02")[1]
    plan.write_text(text.replace('"08:00", "09:00"', '"23:00", "09:00"'))  # open since yesterday
    code, out, _ = said(plan, "--by", "9 h")
    assert code == 0
    assert "within 9 h" in out


def test_a_mission_that_is_later_than_its_own_deadline_is_told_so(plan: Path, said: Said) -> None:
    """Whether all must be completed by a time or not."""
    plan.write_text(plan.read_text().replace('"M1"', '"M1"\ndeadline = "5 s"'))
    for words in (), ("--by", "1 h"):
        code, out, _ = said(plan, *words)
        assert code == 1
        assert 'runs: mission "M1" is late: its deadline has passed\n' in out


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["--by", "soon"], '"soon" is not a time: write a number and a unit'),
        (["--by", "25:00"], '"25:00" is not a time of day: write it like "08:00"'),
        (["--confidence", "99"], '"99" is not between 50 % and 99.99 %: write it like 99%'),
        (["--runs", "10"], "10 runs cannot show 80 %: that takes 11 or more, if all succeed"),
        (["--plot", "p.pdf"], "a plot is an SVG or a PNG"),
        (["--max", "0"], '"0" is not between 1 and 1000'),
        (["--jobs", "0"], '"0" is not between 1 and 256'),
    ],
)
def test_wrong_words_are_exit_2(plan: Path, said: Said, words: list[str], why: str) -> None:
    """Before anything flies."""
    code, out, err = said(plan, *words)
    assert (code, out) == (2, "")
    assert why in err


def test_what_repeats_until_stopped_has_no_size(plan: Path, said: Said) -> None:
    """It is never completed."""
    plan.write_text(plan.read_text().replace('"M1"', '"M1"\nrepeat = true'))
    code, _, err = said(plan, "--by", "1 h")
    assert code == 2
    assert "repeats until it is stopped" in err


def test_the_picture_is_the_same_each_time(plan: Path, said: Said) -> None:
    """A point with its bounds for each number of drones."""
    pytest.importorskip("matplotlib")
    pictures = [plan.with_name(f"{name}.svg") for name in ("one", "two")]
    for picture in pictures:
        assert said(plan, "--by", "50 s", "--plot", picture)[0] == 0
    one, two = (picture.read_bytes() for picture in pictures)
    assert one == two
    assert one.startswith(b"<?xml")
