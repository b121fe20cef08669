"""What `docs/operations.md` tells people to type is what the command line takes."""

from __future__ import annotations

import re
import shlex

import pytest

from pluto_fleet.cli.options import ACTIONS, ANSWERS, parse
from pluto_fleet.cli.supervise import GIVES_UP_AFTER
from tests.library.files.an_app import APP
from tests.paths import ROOT

PAGE = (ROOT / "docs" / "operations.md").read_text(encoding="utf-8")
TYPED = [
    command
    for command in re.findall(r"(?:^\$ |`|/)alfalfa ([^`\n;#]+)", PAGE, re.MULTILINE)
    if "…" not in command and not command.startswith("/")
]


@pytest.mark.parametrize("command", TYPED)
def test_a_command_of_the_page_is_one(command: str) -> None:
    """With what is in brackets, and without."""
    for words in (re.sub(r"[\[\]]", "", command), re.sub(r"\[.*\]", "", command)):
        if words.strip() == "decide J MISSION":
            continue
        assert parse(APP, shlex.split(words)).command == shlex.split(words)[0]


def test_the_page_leaves_no_command_out() -> None:
    said = " ".join(TYPED)
    assert all(f"tell J {action}" in said for action in ACTIONS)
    assert all(
        re.search(rf'decide J "North field" {one}\b', said) for one in ANSWERS if one != "go-on"
    )
    assert "`go-on`" in PAGE
    assert all(f"{flag}`" in PAGE for flag in ("--supervise", "--rtl", "--land", "--journal"))


def test_the_page_says_when_supervision_gives_up() -> None:
    words = ("none", "one", "two", "three", "four", "five", "six", "seven")
    assert f"gives up after {words[GIVES_UP_AFTER]} crashes in a row" in PAGE
