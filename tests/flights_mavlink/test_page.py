"""`docs/mavlink.md` has a row of each scenario: `--update` writes them anew."""

from __future__ import annotations

import tomllib
from pathlib import Path

from tests.paths import ROOT

PAGE = ROOT / "docs" / "mavlink.md"
HEAD = "| what | what comes of it |\n| --- | --- |\n"


def test_the_page_says_what_comes_of_each_scenario(update: bool) -> None:
    known = tomllib.loads(Path(__file__).with_name("scenarios.toml").read_text(encoding="utf-8"))
    rows = "\n".join(f"| {one['name']} | {one['comes']} |" for one in known["scenario"])
    before, head, rest = PAGE.read_text(encoding="utf-8").partition(HEAD)
    table, end, after = rest.partition("\n\n") if "\n\n" in rest else (rest.rstrip("\n"), "\n", "")
    if update:
        PAGE.write_text(before + head + rows + end + after, encoding="utf-8")
        table = rows
    assert table == rows
