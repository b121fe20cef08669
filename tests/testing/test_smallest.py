"""What is found is made smaller, and stays what it was."""

from __future__ import annotations

import json
import re
from pathlib import Path
from random import Random

import pytest

from plutoc_runtime.files.fleet import default_fleet
from plutoc_runtime.testing import invariants
from plutoc_runtime.testing.alike import Alike
from plutoc_runtime.testing.command import test as trial
from plutoc_runtime.testing.explore import small_case
from plutoc_runtime.testing.rule import Say, at
from plutoc_runtime.trace import Event
from tests.testing.mutants import free_in_flight
from tests.testing.random_apps import random_app

Said = pytest.CaptureFixture[str]


class NothingFails:
    """A rule that is broken where a fleet cannot fly a mission, and that says nothing of drones."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self.hears = {"mission.ended": self._end}

    def _end(self, event: Event) -> None:
        if "can" in str(event["reason"]):
            self._say(f"{at(event)}: {event['mission']} cannot be flown")


@pytest.mark.parametrize("number", [0, 1, 3, 5])
def test_the_smallest_case_shows_what_was_found_first(
    number: int, capfd: Said, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Not that a fleet without the drones for it cannot fly it; and each command shows it again."""
    free_in_flight(monkeypatch)
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
    """Whoever it was, whenever, however much: it is the same rule, broken in the same way."""
    app = random_app(Random("0/app"))
    alike = Alike(small_case(app, default_fleet(app), 0))
    assert alike.kind("1.5 s: cf1 is free in the air") == alike.kind(
        "1e-05 s: cf5 is free in the air"
    )
    assert alike.kind("3 s: m2 ended 2 times") == alike.kind("4.25 s: m1 ended 0 times")
    assert alike.kind("waiting: m1, m2, cf1") == alike.kind("waiting: m1")
    assert alike.kind("cf1 at (1.2, -3)") == alike.kind("cf2 at (0.5, 4)")
    assert alike.kind("hook do1 raised") != alike.kind("hook do2 raised")
    assert alike.kind("1 s: cf1 is free in the air") != alike.kind("1 s: cf1 was lost before free")
