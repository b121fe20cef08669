"""`plutoc run`, as a person calls it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP, MISSIONS, Call, tree


def test_missions_fly_and_nothing_is_left(
    plutoc: Call, app: Path, here: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Neither beside the app nor among temporary files."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    before = tree(here)
    said = plutoc("run", app)
    assert said.code == 0
    assert "1 of 1 missions completed" in said.out or "1 of 1 mission completed" in said.out
    assert tree(here) == before
    assert list(tmp_path.iterdir()) == [here]


def test_json_and_seed_are_passed_on(plutoc: Call, app: Path) -> None:
    """And what is printed is the app's own."""
    said = plutoc("run", app, "--json", "--seed", "7", "--missions", "missions.toml")
    facts = json.loads(said.out)
    assert (facts["app"], facts["seed"], facts["missions"][0]["status"]) == ("crop", 7, "COMPLETED")


def test_mishaps_and_many_runs_are_passed_on(plutoc: Call, app: Path) -> None:
    """As the app's own `simulate` takes them."""
    said = plutoc("run", app, "--fail", "crash=100%", "--seed", "3", "--runs", "2", "--json")
    facts = json.loads(said.out)
    assert said.code == 1
    assert [run["seed"] for run in facts["runs"]] == [3, 4]
    assert all(run["crashed_drones"] for run in facts["runs"])
    said = plutoc("run", app, "--fail", "rain=10%")
    assert said.code == 2
    assert '"rain" cannot go wrong' in said.err


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["--fail", "rain=10%"], '--fail: "rain" cannot go wrong'),
        (["--fail", "crash=200%"], "--fail: crash=200% is not between 0% and 100%"),
        (["--runs", "0"], '--runs: "0" is less than 1'),
        (["--runs", "x"], '--runs: "x" is not a whole number'),
        (["--until", "0"], '--until: "0" is not more than 0'),
        (["--until", "soon"], '--until: "soon" is not a time'),
    ],
)
def test_what_simulate_would_refuse_is_refused_in_the_words_of_who_has_typed_it(
    plutoc: Call, app: Path, words: list[str], why: str
) -> None:
    """With the usage of `plutoc run`, and before anything is compiled."""
    app.write_text("this is no app")
    said = plutoc("run", app, *words)
    assert said.code == 2
    assert f"plutoc run: error: argument {why}" in said.err
    assert "simulate" not in said.err


def test_a_fleet_that_is_a_link_to_nowhere_is_not_passed_over(plutoc: Call, app: Path) -> None:
    """Other drones were meant than those that would fly then."""
    Path("fleet.toml").symlink_to("nowhere.toml")
    for words in (["run"], ["test", "--seeds", "1"]):
        said = plutoc(words[0], app, *words[1:])
        assert (said.code, said.err) == (2, "fleet.toml: there is no such file\n")


def test_bad_missions_end_with_2(plutoc: Call, app: Path) -> None:
    """The app's own exit code is passed on, and its message."""
    Path("missions.toml").write_text(MISSIONS.replace("take_photo", "take_foto"))
    said = plutoc("run", app)
    assert said.code == 2
    assert "missions.toml" in said.err
    assert "take_photo" in said.err


def test_without_missions_there_is_nothing_to_fly(plutoc: Call, app: Path) -> None:
    """The message says which flag helps."""
    Path("missions.toml").unlink()
    said = plutoc("run", app)
    assert said.code == 2
    assert "--missions" in said.err


def test_a_fleet_beside_the_app_is_flown(plutoc: Call, app: Path) -> None:
    """Unless another one is named."""
    drone = '[map]\nsize = [9, 9]\n[[drone]]\nid = "{}"\ncategory = "scout"\nhome = [1, 1]\n'
    Path("fleet.toml").write_text(drone.format("mine"))
    Path("other.toml").write_text(drone.format("other"))
    assert json.loads(plutoc("run", app, "--json").out)["drones"][0]["id"] == "mine"
    said = plutoc("run", app, "--json", "--fleet", "other.toml")
    assert json.loads(said.out)["drones"][0]["id"] == "other"


def test_a_fleet_beside_missions_that_are_named_is_flown(plutoc: Call, app: Path) -> None:
    """As the app's own `simulate` flies it, rather than the one beside the app; and that is said."""
    drone = '[map]\nsize = [9, 9]\n[[drone]]\nid = "{}"\ncategory = "scout"\nhome = [1, 1]\n'
    other = Path("other")
    other.mkdir()
    (other / "missions.toml").write_text(MISSIONS)
    Path("fleet.toml").write_text(drone.format("mine"))
    for command in ("run", "test"):
        words = ["--strike", "-"] if command == "test" else ["--json"]
        said = plutoc(command, app, "--missions", "other/missions.toml", *words)
        assert said.err == "fleet: fleet.toml, beside the app; or name one: --fleet\n"
        assert "mine" in said.out
    (other / "fleet.toml").write_text(drone.format("theirs"))
    for command in ("run", "test"):
        words = ["--strike", "-"] if command == "test" else ["--json"]
        said = plutoc(command, app, "--missions", "other/missions.toml", *words)
        assert said.err == "fleet: other/fleet.toml, beside the missions; or name one: --fleet\n"
        assert "theirs" in said.out and "mine" not in said.out


def test_what_repeats_for_ever_is_flown_for_so_long(plutoc: Call, app: Path) -> None:
    """`simulate` asks for it, and so it can be given to `run`."""
    said = plutoc("run", app, "--until", "10 s", "--json")
    assert json.loads(said.out)["duration_s"] == 10.0


JUDGE = """from . import Verdict
from .words import WORD

async def pollinate(drone, trip, context, *, dose):
    return dose

def find_blooms(mission, results):
    return Verdict(ok=True, log=(WORD,))
"""


def test_the_hooks_that_count_are_always_the_newest(plutoc: Call, app: Path, here: Path) -> None:
    """The package's own with its neighbours, else those beside the app."""
    said = plutoc("run", app)
    assert "write it in hooks.py" in said.out
    Path("hooks.py").write_text(JUDGE.replace("from .words import WORD", 'WORD = "beside"'))
    assert "beside" in plutoc("run", app).out
    Path("hooks.py").unlink()
    assert "write it in hooks.py" in plutoc("run", app).out
    plutoc("compile", app)
    Path("crop/src/crop/hooks.py").write_text(JUDGE)
    Path("crop/src/crop/words.py").write_text('WORD = "the first word"\n')
    assert "the first word" in plutoc("run", app).out
    Path("crop/src/crop/words.py").write_text('WORD = "another word"\n')
    assert "another word" in plutoc("run", app).out


def test_errors_end_with_1_and_nothing_flies(plutoc: Call, app: Path) -> None:
    """As with the other commands."""
    app.write_text(APP.replace("-> judge", "-> juge"))
    said = plutoc("run", app)
    assert said.code == 1
    assert not said.out
