"""`plutoc test`: an app under everything that can go wrong."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest

from plutoc.cli import main
from tests.kit.apps import EXAMPLES

Said = pytest.CaptureFixture[str]


@pytest.fixture
def app(tmp_path: Path) -> Path:
    """An example with hooks, in a folder of its own, and without missions of its own."""
    folder = tmp_path / "alfalfa"
    shutil.copytree(EXAMPLES / "alfalfa", folder, ignore=shutil.ignore_patterns("missions.toml"))
    return folder / "app.pluto"


@pytest.fixture
def broken(app: Path) -> Path:
    """The same app, whose evaluator does not expect what its own action gives."""
    hooks = app.with_name("hooks.py")
    text = hooks.read_text(encoding="utf-8")
    guard = "if not isinstance(result.value, Photo):"
    assert guard in text
    hooks.write_text(text.replace(guard, "if result.value.sees is None:"), encoding="utf-8")
    return app


def test_a_sound_app_is_sound(capfd: Said) -> None:
    """It says how often what has struck, and what came of all runs."""
    app = EXAMPLES / "drugs_distribution" / "app.pluto"  # a fourth of the runs that others need
    assert main(["test", str(app), "--seeds", "1"]) == 0
    out = capfd.readouterr().out
    died = (
        r"the app died before it had written down what it was about to do +\d+  --strike crash-lost"
    )
    assert re.search(rf"^{died}$", out, re.MULTILINE)
    assert re.search(r"^\d+ missions ended: \d+ were completed", out, re.MULTILINE)
    assert out.endswith("No run did what no run may do.\n")


def test_a_mistake_in_a_hook_is_found_and_shown_small(
    broken: Path, capfd: Said, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With the files and the command that show it again; they do."""
    monkeypatch.chdir(broken.parent)
    assert main(["test", "app.pluto", "--seeds", "3"]) == 1
    out = capfd.readouterr().out
    sentence = "hook find_blooms raised AttributeError: 'float' object has no attribute 'sees'"
    first, small = out.split("The smallest case that shows the same:")
    assert sentence in first.partition("What was found first:")[2]
    assert sentence in small
    files, _, command = out.partition("# failing.toml\n")[2].partition("\nSave that")
    missions, fleet = files.split("# failing-fleet.toml\n")
    assert missions.count("[[mission.trip]]") == 1
    assert fleet.count("[[drone]]") == 1
    Path("failing.toml").write_text(missions, encoding="utf-8")
    Path("failing-fleet.toml").write_text(fleet, encoding="utf-8")
    words = command.splitlines()[-1].split()
    found = re.findall(r"^  (plutoc test .*)$", first, re.MULTILINE)[0].split()
    for one in (words, found):
        assert one[:2] == ["plutoc", "test"]
        assert main(one[1:]) == 1
        again = capfd.readouterr().out
        assert "trip" in again and " launched" in again
        assert sentence in again


def test_a_hook_that_raises_keyboard_interrupt_interrupts_nothing(app: Path, capfd: Said) -> None:
    """It is found as anything else that a hook raises: only a person interrupts."""
    hooks = app.with_name("hooks.py")
    text = hooks.read_text(encoding="utf-8")
    begins = "    for result in results.new:"
    assert begins in text
    hooks.write_text(
        text.replace(begins, f"    raise KeyboardInterrupt\n{begins}"), encoding="utf-8"
    )
    assert main(["test", str(app), "--seeds", "1"]) == 1
    said = capfd.readouterr()
    assert "it may not raise KeyboardInterrupt" in said.out
    assert "interrupted" not in said.err


def test_a_case_is_said_to_show_it_only_if_its_command_does(app: Path, capfd: Said) -> None:
    """What hooks.py keeps from run to run is not there when the command is typed."""
    hooks = app.with_name("hooks.py")
    text = hooks.read_text(encoding="utf-8")
    begins = "    done = {result.trip.target"
    assert begins in text
    counted = (
        "    CALLS.append(1)\n    if len(CALLS) > 30:\n        raise LookupError('too many')\n"
    )
    text = text.replace(begins, counted + begins)
    hooks.write_text(text + "\n\nCALLS = []\n", encoding="utf-8")
    assert main(["test", str(app), "--seeds", "1"]) == 1
    out = capfd.readouterr().out
    assert "LookupError: too many" in out.partition("What was found first:")[2]
    assert "flown once more by itself, the case did not show it" in out
    assert "The smallest case" not in out


def test_a_program_gets_one_object(broken: Path, capfd: Said) -> None:
    """With every finding, and the smallest case as text."""
    assert main(["test", str(broken), "--seeds", "1", "--json"]) == 1
    data = json.loads(capfd.readouterr().out)
    assert list(data) == [
        "app",
        "runs",
        "lives",
        "rows",
        "missions",
        "struck",
        "findings",
        "smallest",
    ]
    assert data["findings"][0]["seed"] == 0
    assert list(data["findings"][0]) == ["seed", "what", "strike", "weather"]
    assert list(data["smallest"]) == ["what", "seed", "strike", "weather", "missions", "fleet"]


def test_its_own_missions_are_tried_when_asked_for(app: Path, capfd: Said) -> None:
    """What would repeat for ever repeats once."""
    missions = app.with_name("mine.toml")
    missions.write_text(
        "[[mission]]\nrepeat = true\n[[mission.trip]]\n" 'action = "take_photo"\ntarget = [3, 3]\n'
    )
    code = main(["test", str(app), "--missions", str(missions), "--seeds", "1", "--json"])
    data = json.loads(capfd.readouterr().out)
    assert (code, data["findings"]) == (0, [])
    assert data["missions"]["COMPLETED"] > 20


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["--strike", "fire@3"], "fire is nothing that can strike"),
        (["--weather", "rain=1"], "rain is no weather"),
        (["--seeds", "0"], "less than 1"),
        (["--missions", "none.toml"], "there is no such file"),
    ],
)
def test_what_cannot_be_tried_is_exit_2(app: Path, capfd: Said, words: list[str], why: str) -> None:
    """And says why."""
    assert main(["test", str(app), *words]) == 2
    said = capfd.readouterr().err
    assert why in said
    assert "--file" not in said  # which is only between plutoc and the package


def test_a_broken_source_is_exit_1(app: Path, capfd: Said) -> None:
    """As with every command; nothing is tried."""
    app.write_text("pluto 1\napp x {\n", encoding="utf-8")
    assert main(["test", str(app)]) == 1
    assert "error" in capfd.readouterr().err
