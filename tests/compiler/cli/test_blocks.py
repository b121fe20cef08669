"""`plutoc blocks`, as a person calls it, and the pages that are made in the same way."""

from __future__ import annotations

from importlib.metadata import EntryPoint, EntryPoints

import pytest

from plutoc import registry
from plutoc.report.block_page import first_line, page
from tests.compiler.cli.conftest import Call
from tests.paths import ROOT

KINDS = sorted(registry.blocks_of(registry.STD))
PAGES = ROOT / "docs" / "blocks"


def test_every_block_is_listed_with_what_it_does(plutoc: Call) -> None:
    """A line each."""
    said = plutoc("blocks")
    assert (said.code, said.err) == (0, "")
    assert len(said.out.splitlines()) >= len(KINDS)
    for kind in KINDS:
        assert first_line(registry.blocks_of(registry.STD)[kind]) in said.out


@pytest.mark.parametrize("kind", KINDS)
def test_a_page_is_current(plutoc: Call, kind: str, update: bool) -> None:
    """docs/blocks has just what the command prints; `--update` writes it."""
    text = plutoc("blocks", kind).out
    path = PAGES / f"{kind}.md"
    if update:
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    assert path.read_text(encoding="utf-8") == text


def test_the_list_of_pages_is_current(update: bool) -> None:
    """In the order in which the blocks are declared, each with a link."""
    blocks = registry.blocks_of(registry.STD)
    rows = [f"| [{kind}]({kind}.md) | {first_line(block)} |" for kind, block in blocks.items()]
    head = "# The blocks\n\n`plutoc blocks KIND` prints these pages, and those of other packages.\n"
    text = "\n".join([head, "| block | does |", "|---|---|", *rows, ""])
    path = PAGES / "README.md"
    if update:
        path.write_text(text, encoding="utf-8")
    assert path.read_text(encoding="utf-8") == text
    assert sorted(file.stem for file in PAGES.glob("*.md")) == sorted([*KINDS, "README"])


def test_a_page_says_what_comes_in_and_goes_out(plutoc: Call) -> None:
    """Statuses, parameters with units, and fields."""
    text = plutoc("blocks", "TimerMonitor").out
    assert "| RUNNING | STANDBY, COMPLETED, FAILED |" in text
    assert "- `default`: a time (ms, s, min, h), at least 0." in text
    assert "- `safe_time` of a mission: a time." in text


def test_an_unknown_block_ends_with_2(plutoc: Call) -> None:
    """It says which one was meant."""
    said = plutoc("blocks", "TimeMonitor")
    assert said.code == 2
    assert "did you mean TimerMonitor" in said.err
    assert "did you mean GateFIFO or GateFunnel?" in plutoc("blocks", "gate").err


def test_a_broken_package_is_named_and_the_others_are_listed(
    plutoc: Call, monkeypatch: pytest.MonkeyPatch
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
    assert len(said.out.splitlines()) == len(KINDS)


def test_a_block_of_a_package_has_its_prefix() -> None:
    """The page's title is how an app writes the kind."""
    block = registry.blocks_of(registry.STD)[KINDS[0]]
    assert page(f"survey.{KINDS[0]}", block).startswith(f"# survey.{KINDS[0]}\n")
