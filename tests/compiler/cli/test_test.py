"""`plutoc test`: an app under everything that can go wrong."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest

from tests.kit.apps import EXAMPLES
from tests.kit.command import plutoc

pytestmark = [pytest.mark.long, pytest.mark.process]


@pytest.fixture
def app(here: Path) -> Path:
    """An example with hooks, in a folder that we are in, and without missions of its own."""
    without = shutil.ignore_patterns("missions.toml")
    shutil.copytree(EXAMPLES / "alfalfa", here, ignore=without, dirs_exist_ok=True)
    return Path("app.pluto")


def edit(old: str, new: str) -> None:
    """Change the app's hooks."""
    hooks = Path("hooks.py")
    text = hooks.read_text(encoding="utf-8")
    assert old in text
    hooks.write_text(text.replace(old, new), encoding="utf-8")


def broken() -> None:
    """Let the evaluator not expect what the app's own action gives."""
    edit("if not isinstance(result.value, Photo):", "if result.value.sees is None:")


def test_a_sound_app_is_sound() -> None:
    """It says how often what has struck, and what came of all runs."""
    app = EXAMPLES / "drugs_distribution" / "app.pluto"  # a fourth of the runs that others need
    said = plutoc("test", app, "--seeds", "1")
    died = (
        r"the app died before it had written down what it was about to do +\d+  --strike crash-lost"
    )
    assert said.code == 0
    assert re.search(rf"^{died}$", said.out, re.MULTILINE)
    assert re.search(r"^\d+ missions ended: \d+ were completed", said.out, re.MULTILINE)
    assert said.out.endswith("No run did what no run may do.\n")


def test_a_mistake_in_a_hook_is_found_and_shown_small(app: Path) -> None:
    """With the files and the command that show it again; they do."""
    broken()
    said = plutoc("test", "app.pluto", "--seeds", "3")
    assert said.code == 1
    sentence = "hook find_blooms raised AttributeError: 'float' object has no attribute 'sees'"
    first, small = said.out.split("The smallest case that shows the same:")
    assert sentence in first.partition("What was found first:")[2]
    assert sentence in small
    files, _, command = said.out.partition("# failing.toml\n")[2].partition("\nSave that")
    missions, fleet = files.split("# failing-fleet.toml\n")
    assert missions.count("[[mission.trip]]") == 1
    assert fleet.count("[[drone]]") == 1
    Path("failing.toml").write_text(missions, encoding="utf-8")
    Path("failing-fleet.toml").write_text(fleet, encoding="utf-8")
    words = command.splitlines()[-1].split()
    found = re.findall(r"^  (plutoc test .*)$", first, re.MULTILINE)[0].split()
    for one in (words, found):
        assert one[:2] == ["plutoc", "test"]
        again = plutoc(*one[1:])
        assert again.code == 1
        assert "trip" in again.out and " launched" in again.out
        assert sentence in again.out


def test_a_hook_that_raises_keyboard_interrupt_interrupts_nothing(app: Path) -> None:
    """It is found as anything else that a hook raises: only a person interrupts."""
    begins = "    for result in results.new:"
    edit(begins, f"    raise KeyboardInterrupt\n{begins}")
    said = plutoc("test", app, "--seeds", "1")
    assert said.code == 1
    assert "it may not raise KeyboardInterrupt" in said.out
    assert "interrupted" not in said.err


def test_its_own_missions_are_tried_when_asked_for(app: Path) -> None:
    """What would repeat for ever repeats once."""
    Path("mine.toml").write_text(
        '[[mission]]\nrepeat = true\n[[mission.trip]]\naction = "take_photo"\ntarget = [3, 3]\n'
    )
    said = plutoc("test", app, "--missions", "mine.toml", "--seeds", "1", "--json")
    data = json.loads(said.out)
    assert (said.code, data["findings"]) == (0, [])
    assert data["missions"]["COMPLETED"] > 20
