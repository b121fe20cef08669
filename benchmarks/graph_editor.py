"""How fast is the graph editor with three hundred blocks?

`python benchmarks/graph_editor.py` opens them in Chromium, drags one for some seconds, and tidies. What
we promise: seen within 1.5 s, of which the first paint within 1 s; 50 frames a second; tidied within 1 s.
"""

from __future__ import annotations

import argparse
import sys
import time
from itertools import pairwise
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).parents[1]))

from playwright.sync_api import Page, sync_playwright

from measuring.options import at_least_one
from tests.compiler.editor.browser.large import large
from tests.kit.browser import ARGUMENTS, chromium
from tests.kit.editor import NAME, EditorProcess

DRAGGED = 3.0
"""Seconds."""
COUNTS = """
window.frames_ = [];
window.counting = true;
const count = (now) => { window.frames_.push(now); if (window.counting) requestAnimationFrame(count); };
requestAnimationFrame(count);
"""


def opened(page: Page, url: str) -> tuple[float, float]:
    """Open the editor; return the milliseconds until something was painted, and until all blocks were."""
    page.goto(url)
    page.wait_for_selector(".block[data-block=end]")
    painted = page.evaluate(
        "performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? performance.now()"
    )
    seen = page.evaluate(
        "new Promise((done) => requestAnimationFrame(() => done(performance.now())))"
    )
    return painted, seen


def dragged(page: Page) -> list[float]:
    """Drag a block about; return how long each frame took, in milliseconds."""
    box = page.locator(".block[data-block=launch_1]").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.evaluate(COUNTS)
    page.mouse.move(x, y)
    page.mouse.down()
    end, step = time.monotonic() + DRAGGED, 0
    while time.monotonic() < end:
        step += 1
        page.mouse.move(x + step % 60 * 2, y + step % 40 * 2)
    page.evaluate("window.counting = false")
    frames = page.evaluate("window.frames_")
    page.mouse.up()
    return [after - before for before, after in pairwise(frames)]


def tidied(page: Page) -> float:
    """Tidy; return the seconds until the server has answered and the page is drawn."""
    begun = time.monotonic()
    page.evaluate("import('/static/link.js').then((link) => link.ask('tidy'))")
    page.evaluate("new Promise((done) => requestAnimationFrame(done))")
    return time.monotonic() - begun


def main() -> None:
    """Measure some rounds, and print each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=at_least_one, default=3)
    rounds = parser.parse_args().rounds
    with TemporaryDirectory() as name, sync_playwright() as driver:
        editor = EditorProcess(file=Path(name) / NAME)
        editor.file.write_text(large(), encoding="utf-8")
        editor.start()
        browser = driver.chromium.launch(executable_path=chromium(), args=ARGUMENTS)
        try:
            for _ in range(rounds):
                page = browser.new_page(viewport={"width": 1366, "height": 768})
                painted, seen = opened(page, editor.url)
                page.wait_for_selector(".cm-content")
                frames = dragged(page)
                rate = 1000 * len(frames) / sum(frames)
                print(
                    f"painted {painted:.0f} ms  seen {seen:.0f} ms  {rate:.0f} frames a second"
                    f" (median {median(frames):.1f} ms)  tidied {1000 * tidied(page):.0f} ms"
                )
                page.close()
        finally:
            browser.close()
            editor.end()


if __name__ == "__main__":
    main()
