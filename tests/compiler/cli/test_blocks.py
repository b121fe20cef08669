"""`plutoc blocks`, and the pages that are made in the same way."""

from __future__ import annotations

from importlib.metadata import EntryPoint, EntryPoints

import pytest

from plutoc import registry
from plutoc.report.block_page import first_line, page
from tests.kit.command import plutoc
from tests.paths import ROOT

BLOCKS = registry.blocks_of(registry.STD)
PAGES = ROOT / "docs" / "blocks"


def test_every_block_is_listed_with_what_it_does() -> None:
    """A line each."""
    said = plutoc("blocks")
    assert (said.code, said.err) == (0, "")
    assert all(first_line(block) in said.out for block in BLOCKS.values())


def test_the_pages_are_current(update: bool) -> None:
    """docs/blocks has just what the command prints, and a list of all; `--update` writes them."""
    pages = {kind: plutoc("blocks", kind).out for kind in BLOCKS}
    rows = [f"| [{kind}]({kind}.md) | {first_line(block)} |" for kind, block in BLOCKS.items()]
    head = "# The blocks\n\n`plutoc blocks KIND` prints these pages, and those of other packages.\n"
    pages["README"] = "\n".join([head, "| block | does |", "|---|---|", *rows, ""])
    if update:
        for name, text in pages.items():
            (PAGES / f"{name}.md").write_text(text, encoding="utf-8")
    assert {path.stem: path.read_text("utf-8") for path in PAGES.glob("*.md")} == pages


def test_a_broken_package_is_named_and_the_others_are_listed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It ends with 1."""
    ours = EntryPoint(name="std", value="plutoc_blocks:BLOCKS", group=registry.GROUP)
    theirs = EntryPoint(name="broken", value="not_there:BLOCKS", group=registry.GROUP)

    def found(group: str, name: str | None = None) -> EntryPoints:
        points = EntryPoints([ours, theirs])
        return points.select(name=name) if name else points

    monkeypatch.setattr("plutoc.registry.entry_points", found)
    said = plutoc("blocks")
    assert said.code == 1
    assert "the blocks of broken cannot be loaded" in said.err
    assert len(said.out.splitlines()) == len(BLOCKS)


def test_a_block_of_a_package_has_its_prefix() -> None:
    """The page's title is how an app writes the kind."""
    block = BLOCKS["TimerMonitor"]
    assert page("survey.TimerMonitor", block).startswith("# survey.TimerMonitor\n")
