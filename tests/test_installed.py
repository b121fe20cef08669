"""An installed package is told from another release of it by its files, and nothing is imported."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from plutoc.installed import facts_of_package, last_facts_of_package

NAME = "somebodys_survey"


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package that cannot be imported."""
    folder = tmp_path / NAME
    folder.mkdir()
    (folder / "__init__.py").write_text("1 / 0\n")
    (folder / "page.html").write_text("<p>\n")
    monkeypatch.syspath_prepend(tmp_path)
    return folder


def test_every_file_counts_and_what_python_keeps_does_not(package: Path) -> None:
    (package / "__pycache__").mkdir()
    (package / "__pycache__" / "kept.pyc").touch()
    paths = [fact.split()[0] for fact in facts_of_package(NAME)]
    assert paths == [str(package / "__init__.py"), str(package / "page.html")]
    assert NAME not in sys.modules


def test_what_came_meanwhile_is_noticed_by_the_next_who_looks(package: Path) -> None:
    """What was compiled is kept for what was there before, and not for what is there now."""
    before = facts_of_package(NAME)
    (package / "page.html").write_text("<p>changed\n")
    assert last_facts_of_package(NAME) == before
    assert facts_of_package(NAME) != before
    assert last_facts_of_package(NAME) == facts_of_package(NAME)
