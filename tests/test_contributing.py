"""The page for contributors says where the tests of each block, command and page are, and they are there."""

from __future__ import annotations

import re

from plutoc.cli.options import all_commands
from plutoc_blocks import BLOCKS
from tests.paths import ROOT

PAGE = (ROOT / "docs" / "contributing.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| ([^|]+) \| (tests/[^|]+) \|$", PAGE, re.MULTILINE)
NAMED = {name.strip(" `") for names, _ in ROWS for name in names.split(",")}


def test_each_place_that_is_named_is_there() -> None:
    places = [place.strip() for _, places in ROWS for place in places.split(",")]
    assert [place for place in places if not (ROOT / place).exists()] == []


def test_each_block_has_its_row() -> None:
    assert {block.name for block in BLOCKS} <= NAMED


def test_each_command_has_its_row() -> None:
    commands = re.findall(r"^    (\w+) ", all_commands().format_help(), re.MULTILINE)
    assert {f"plutoc {command}" for command in commands} <= NAMED


def test_each_page_of_the_station_has_its_row() -> None:
    pages = (ROOT / "runtime" / "pluto_fleet" / "station" / "pages").glob("*/page.js")
    assert {page.parent.name for page in pages} <= NAMED
