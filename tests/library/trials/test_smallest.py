"""What is found is made smaller, and stays what it was."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest

from pluto_fleet.app import App
from pluto_fleet.files.fleet import default_fleet
from pluto_fleet.shared.alone import simulate
from pluto_fleet.shared.domain.model import Drone
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.fleet.fleet import Fleet
from pluto_fleet.shared.hooks.context import Context
from pluto_fleet.trials import command as trials
from pluto_fleet.trials import explore, invariants
from pluto_fleet.trials.command import Options, report
from pluto_fleet.trials.command import test as trial
from pluto_fleet.trials.explore import MistakeKinds, Tally, small_case
from pluto_fleet.trials.rules import Say, at
from tests.trials.examples import app_of
from tests.trials.mutants import a_drone_is_free_in_flight
from tests.trials.strangers import random_app

Said = pytest.CaptureFixture[str]
APPS = Path(__file__).with_name("apps")


class NothingFails:
    """A rule that is broken where a fleet cannot fly a mission, and that says nothing of drones."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self.hears = {"mission.ended": self._end}

    def _end(self, event: Event) -> None:
        if "can" in str(event["reason"]):
            self._say(f"{at(event)}: {event['mission']} cannot be flown")


@pytest.mark.parametrize("number", [0, 3])
def test_the_smallest_case_shows_what_was_found_first(
    number: int, capfd: Said, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Not that a fleet without the drones for it cannot fly it; and each command shows it again."""
    a_drone_is_free_in_flight(monkeypatch)
    monkeypatch.setattr(invariants, "RULES", (*invariants.RULES, NothingFails))
    app = random_app(Random(f"{number}/app"))
    monkeypatch.chdir(tmp_path)
    assert trial(app, ["--file", "app.pluto", "--seeds", "1", "--json"]) == 1
    data = json.loads(capfd.readouterr().out)
    first, smallest = data["findings"][0], data["smallest"]
    assert "is free in the air" in first["what"][0]
    assert "is free in the air" in smallest["what"][0]
    assert not re.search(r"cannot be flown", "".join(smallest["what"]))

    Path("failing.toml").write_text(smallest["missions"], encoding="utf-8")
    Path("failing-fleet.toml").write_text(smallest["fleet"], encoding="utf-8")
    assert trial(app, ["--file", "app.pluto", "--seeds", "1"]) == 1
    commands = re.findall(r"^  plutoc test app.pluto (.*)$", capfd.readouterr().out, re.MULTILINE)
    assert len(commands) == 2
    for command, shown in zip(commands, (first, smallest), strict=True):
        assert trial(app, ["--file", "app.pluto", *command.split()]) == 1
        said = capfd.readouterr().out
        assert [sentence in said for sentence in shown["what"]] == [True] * len(shown["what"])


def test_two_sentences_are_of_one_kind_if_only_names_and_numbers_differ() -> None:
    """For any drone, at any time, of any size: it is the same rule, broken in the same way."""
    app = random_app(Random("0/app"))
    alike = MistakeKinds(small_case(app, default_fleet(app), 0))
    assert alike.kind("1.5 s: cf1 is free in the air") == alike.kind(
        "1e-05 s: cf5 is free in the air"
    )
    assert alike.kind("3 s: m2 ended 2 times") == alike.kind("4.25 s: m1 ended 0 times")
    assert alike.kind("waiting: m1, m2, cf1") == alike.kind("waiting: m1")
    assert alike.kind("cf1 at (1.2, -3)") == alike.kind("cf2 at (0.5, 4)")
    assert alike.kind("hook do1 raised") != alike.kind("hook do2 raised")
    assert alike.kind("no <Bed at 0x7f9dcfc01610>") == alike.kind("no <Bed at 0x5e0>")
    assert alike.kind("57percent at 1.5s") == alike.kind("8percent at 22.25s")
    assert alike.kind("1 s: cf1 is free in the air") != alike.kind("1 s: cf1 was lost before free")


def failing(calls: range, why: Callable[[], str] = lambda: "nothing there") -> App:
    """Return an app whose action fails in these of its calls."""
    called = iter(range(1_000_000))

    async def spray(drone: object, trip: object, context: Context) -> None:
        await context.sleep(2.0)
        if next(called) in calls:
            raise LookupError(why())

    text = (APPS / "duster.pluto").read_text(encoding="utf-8")
    return app_of(text, {"spray": spray, "dust": spray})


@pytest.mark.parametrize("method", ["recover", "engage"])
def test_an_error_of_the_runtime_itself_is_found_as_any_other(
    method: str, capfd: Said, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Wherever it is raised: what was tried until then is not lost, and the case is made smaller."""
    really = getattr(Fleet, method)

    def wrong(self: Fleet, drone: Drone, *given: object) -> object:
        if drone.trips > 0:
            raise KeyError(drone.id)
        return really(self, drone, *given)

    monkeypatch.setattr(Fleet, method, wrong)
    assert trial(random_app(Random("0/app")), ["--file", "app.pluto", "--seeds", "1"]) == 1
    rest = capfd.readouterr().out.partition("What was found first:")[2]
    assert "s: the app ended with an internal error: KeyError: 'cf" in rest
    assert "The smallest case that shows the same:" in rest


def test_what_names_an_object_by_its_address_is_made_smaller(capfd: Said) -> None:
    """It is another one in each run: that is neither chance nor another mistake."""
    objects: list[object] = []

    def why() -> str:
        objects.append(object())  # all are kept: no address is there twice
        return f"no {objects[-1]}"

    app = failing(range(1_000_000), why)
    assert trial(app, ["--file", "app.pluto", "--seeds", "1"]) == 1
    rest = capfd.readouterr().out.partition("What was found first:")[2]
    assert "The smallest case that shows the same:" in rest
    assert "Found later" not in rest


@pytest.mark.parametrize(("seeds", "too_few"), [(1, True), (100, False)])
def test_what_few_seeds_never_try_is_not_blamed_on_the_app(seeds: int, too_few: bool) -> None:
    """Who looks once and quickly is told that longer would be more."""
    said = list(report(failing(range(0)), Options(seeds=seeds), Tally(runs=1), None))
    (never,) = (line for line in said if line.startswith("Never happened"))
    assert never.startswith("Never happened, for want of an occasion")
    assert ("or of more seeds" in never) == too_few


def test_what_does_not_show_again_is_told_as_that(
    capfd: Said, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And no case is said to show it that does not."""
    monkeypatch.setattr(explore, "MOST_ROWS", 3)
    assert trial(failing(range(40, 41)), ["--file", "app.pluto", "--seeds", "1"]) == 1
    rest = capfd.readouterr().out.partition("What was found first:")[2]
    assert "LookupError: nothing there" in rest
    assert "flown once more by itself, the case did not show it" in rest
    assert "The smallest case" not in rest
    assert "See it again" not in rest


def test_actions_that_no_drone_can_do_are_told(
    capfd: Said, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """They are not tried, and they must not be taken for sound, however much strikes."""
    monkeypatch.setattr(trials, "everywhere", lambda app, case: [case])
    fleet = tmp_path / "fleet.toml"
    fleet.write_text('[[drone]]\nid = "w"\ncategory = "watcher"\nhome = [1, 1]\n')
    app = random_app(Random("0/app"))
    assert trial(app, ["--seeds", "1", "--fleet", str(fleet)]) == 0
    why = "no drone of the fleet can do0: it has no worker, so it is not tried"
    assert f"{fleet}: warning: {why}" in capfd.readouterr().err
    assert trial(app, ["--seeds", "1"]) == 0
    assert "warning" not in capfd.readouterr().err


def test_what_was_found_is_told_when_it_is_interrupted(
    capfd: Said, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Who has waited for minutes does not lose it by not waiting any longer."""

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(trials, "shrunk", interrupted)
    with pytest.raises(KeyboardInterrupt):
        trial(failing(range(1_000_000)), ["--file", "app.pluto", "--seeds", "1"])
    rest = capfd.readouterr().out.partition("What was found first:")[2]
    assert "LookupError: nothing there" in rest
    assert "  plutoc test app.pluto --seed 0 " in rest
    assert rest.endswith("It was interrupted before that was made smaller.\n")


def test_an_app_that_tries_for_ever_is_told_after_so_many_flights(
    capfd: Said, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As `simulate` gives it up, and not after a week of simulated flights for each run."""
    monkeypatch.setattr(simulate, "FLIGHTS", 20)
    app = app_of((APPS / "hasty.pluto").read_text(encoding="utf-8"))
    assert trial(app, ["--file", "app.pluto", "--seeds", "1"]) == 1
    rest = capfd.readouterr().out.partition("What was found first:")[2]
    found, _, smallest = rest.partition("The smallest case that shows the same:")
    for said in (found, smallest):
        assert re.search(
            r"^  \S+ s: m\d sets out again and again, and nothing ends", said, re.MULTILINE
        )
    assert smallest.count("[[mission.trip]]") == 1
