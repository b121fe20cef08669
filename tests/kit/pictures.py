"""Pictures of pages for the docs: few colours, so that they are small."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page

COLOURS = 192


def picture(page: Page, colours: int = COLOURS) -> bytes:
    """Return what is on the screen, as a PNG of few colours."""
    shot = Image.open(BytesIO(page.screenshot(animations="disabled", caret="hide")))
    few = shot.convert("RGB").quantize(colours, dither=Image.Dither.NONE)
    out = BytesIO()
    few.save(out, "PNG", optimize=True)
    return out.getvalue()


def kept(folder: Path, name: str) -> Path:
    """Return where a picture is kept."""
    folder.mkdir(exist_ok=True)
    return folder / f"{name}.png"
