"""Pictures and quoted files in the pages are current."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

from plutoc.cli import main

ROOT = Path(__file__).parents[2]


def script() -> ModuleType:
    """Return `docs/tutorial/make_pictures.py`, which is a script and in no package."""
    path = ROOT / "docs" / "tutorial" / "make_pictures.py"
    spec = importlib.util.spec_from_file_location("make_pictures", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


MAKE = script()


@pytest.mark.parametrize("page", MAKE.pages(), ids=lambda page: page.relative_to(ROOT).as_posix())
def test_page_is_current(page: Path) -> None:
    """`python docs/tutorial/make_pictures.py` would change nothing."""
    text = page.read_text(encoding="utf-8")
    assert MAKE.refreshed(text, page.parent) == text


@pytest.mark.parametrize(
    "page", sorted(ROOT.glob("examples/*/README.md")), ids=lambda p: p.parts[-2]
)
def test_readme_of_an_example_shows_its_graph(
    page: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The picture is what `plutoc graph` prints."""
    assert main(["graph", str(page.parent / "app.pluto")]) == 0
    assert f"```mermaid\n{capsys.readouterr().out}```\n" in page.read_text(encoding="utf-8")


@pytest.mark.parametrize("page", MAKE.pages(), ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(page: Path) -> None:
    """What a page refers to in the repository is there."""
    text = re.sub(
        r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL
    )
    for link in re.findall(r"\]\(([^)#\s]+)", text):
        assert "://" in link or (page.parent / link).exists(), link


def test_outdated_picture_is_replaced(tmp_path: Path) -> None:
    """What stood in a marked block before does not matter; the rest of the page stays."""
    (tmp_path / "hooks.py").write_text("x = 1\n", encoding="utf-8")
    old = "a\n\n<!-- file: hooks.py -->\n```python\nold\n```\n\nb ```c``` d\n"
    assert MAKE.refreshed(old, tmp_path) == old.replace("old", "x = 1")
