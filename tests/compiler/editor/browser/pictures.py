"""Pictures of the editor for the docs: it has more colours than the station's pages."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Page

from tests.kit import pictures
from tests.release.environments import ROOT

FOLDER = ROOT / "docs" / "graph-editor"
COLOURS = 224


def picture(page: Page) -> bytes:
    """Return what is on the screen, as a PNG of few colours."""
    return pictures.picture(page, COLOURS)


def kept(name: str) -> Path:
    """Return where a picture is kept."""
    return FOLDER / f"{name}.png"
