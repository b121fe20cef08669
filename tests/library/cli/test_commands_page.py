"""`docs/commands.md` says of each command what its help says: `--update` writes it anew."""

from __future__ import annotations

import re
from argparse import SUPPRESS
from dataclasses import replace

import pytest

from pluto_fleet.cli.options import COMMANDS, TABLE, all_commands
from tests.library.files.an_app import APP
from tests.paths import ROOT

PAGE = ROOT / "docs" / "commands.md"

HEAD = """# The commands of an app

An app that `plutoc` has compiled, here one called `app`, is a program with these commands. The library, `pluto-fleet`, brings them; without it there are `simulate` and
`check`. Each says of itself what stands here: `app COMMAND --help`. [Operations](operations.md) shows them at work.
"""


def page(monkeypatch: pytest.MonkeyPatch) -> str:
    """Return the page."""
    monkeypatch.setenv("COLUMNS", "100")
    _, commands = all_commands(replace(APP, name="app"))
    helps = [f"\n## {name}\n\n```\n{one.format_help()}```\n" for name, one in commands.items()]
    return HEAD + "".join(helps)


def test_the_page_of_the_commands_is_their_help(
    monkeypatch: pytest.MonkeyPatch, update: bool
) -> None:
    written = page(monkeypatch)
    if update:
        PAGE.write_text(written, encoding="utf-8")
    assert PAGE.read_text(encoding="utf-8") == written


def test_the_page_of_the_language_tells_of_each_option() -> None:
    said = (ROOT / "docs" / "language.md").read_text("utf-8")
    said = said[said.index("### The app") : said.index("### Exit codes")]
    told = [row for row in TABLE if row.typed.startswith("--") and row.help != SUPPRESS]
    assert all(
        re.search(rf"{row.typed}\b", said) for row in told if {*row.commands.split()} & {*COMMANDS}
    )
