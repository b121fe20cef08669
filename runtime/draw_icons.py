"""Draw the icons of an installed station from icon.svg: `python runtime/draw_icons.py`, with Chromium on the path."""

from __future__ import annotations

import shutil
from io import BytesIO
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

PAGES = Path(__file__).parent / "pluto_fleet" / "station" / "pages"
SIDES = (192, 512)
"""Pixels: the two that browsers ask for."""
COLOURS = 16
"""Two, and what smooths the edges between them."""


def main() -> None:
    """Write a picture of each size, square to its corners: systems that want them round cut them."""
    drawing = (PAGES / "icon.svg").read_text(encoding="utf-8")
    with sync_playwright() as driver:
        path = shutil.which("chromium") or shutil.which("chromium-browser")
        browser = driver.chromium.launch(executable_path=path, args=["--no-sandbox"])
        for side in SIDES:
            page = browser.new_page(viewport={"width": side, "height": side})
            style = f"body {{ margin: 0; background: #0b5f86 }} svg {{ width: {side}px; display: block }}"
            page.set_content(f"<style>{style}</style>{drawing}")
            drawn = Image.open(BytesIO(page.screenshot())).convert("RGB")
            few = drawn.quantize(COLOURS, dither=Image.Dither.NONE)
            few.save(PAGES / f"icon-{side}.png", optimize=True)
        browser.close()


if __name__ == "__main__":
    main()
