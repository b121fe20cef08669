"""How fast is the station with a plan of two thousand places?

`python benchmarks/large_plan.py` serves a compiled app, gives it a mission of so many trips, and opens its page in
Chromium: how long from navigation until every place is painted, the mission being chosen as soon as it is offered; how many frames a
second while the map is zoomed in and out, and moved where pins are seen; how long after an arrow key a pin is
painted where it went; how many elements the page has. The same is done with a plan of twenty, and the ratios are printed: they
say more than times of a machine that does other things. What we promise: opened within 1.5 s, 30 frames a second. Needs Chromium, and what the extra `test` installs.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import cycle, pairwise
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).parents[1]))

from playwright.sync_api import Browser, Page, sync_playwright

from measuring.options import at_least_one
from tests.kit.browser import ARGUMENTS, LAPTOP, chromium
from watching.flight import SIDE, compiled, fleet
from watching.server import Server, serve

Numbers = dict[str, float]

FEW = 20
SECONDS = 3.0
"""Of zooming, and of moving."""
NOTCHES = 60
"""Steps of the wheel from the whole map to where pins have room, and as many back."""
NOTCH = 40
"""Pixels of one."""

OPENED = """
(count) => new Promise((seen) => {
  const look = () => {
    const choice = document.querySelector(".picker select");
    if (choice && !choice.value) {
      choice.value = choice.options[1].value;
      choice.dispatchEvent(new Event("change", { bubbles: true }));
    }
    const dots = [...document.querySelectorAll(".pins .dots")].map((one) => one.getAttribute("d").split("M").length - 1);
    const drawn = Math.max(document.querySelectorAll(".pin").length, dots.reduce((sum, one) => sum + one, 0));
    if (drawn < count) requestAnimationFrame(look);
    else requestAnimationFrame(() => setTimeout(() => seen(performance.now())));
  };
  look();
})
"""
"""It promises the milliseconds from navigation until so many places are painted."""

COUNTS = """
() => {
  window.frames_ = [];
  window.counting = true;
  const count = (now) => { window.frames_.push(now); if (window.counting) requestAnimationFrame(count); };
  requestAnimationFrame(count);
}
"""

MOVED = """
() => new Promise((moved) => {
  const pin = document.querySelector(".pin");
  pin.focus();
  const mark = () => document.querySelector(`.pin[data-key="${pin.dataset.key}"]`).closest(".mark").getAttribute("transform");
  requestAnimationFrame(() => setTimeout(() => {
    const [before, begun] = [mark(), performance.now()];
    document.activeElement.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
    const look = () => {
      if (mark() === before) requestAnimationFrame(look);
      else setTimeout(() => moved(performance.now() - begun));
    };
    requestAnimationFrame(look);
  }));
})
"""


def plan(places: int) -> list[dict[str, object]]:
    """Return a mission of so many trips in rows over the whole map, as the page would send it."""
    columns = round(places**0.5)
    rows = -(-places // columns)
    trips: list[dict[str, object]] = []
    for number in range(places):
        row, column = divmod(number, columns)
        x = 1 + (SIDE - 2) * column / columns
        y = 4 + (SIDE - 5) * row / rows
        trips.append(
            {
                "key": f"trip{number:08}",
                "name": f"Place {number + 1}",
                "action": "measure",
                "target": [round(x, 2), round(y, 2)],
                "parameters": {},
                "item": None,
            }
        )
    return [{"key": "mission0000", "name": "Survey", "trips": trips}]


@contextmanager
def counted(page: Page) -> Iterator[list[float]]:
    """Count frames; the list has, afterwards, how long each took, in milliseconds."""
    found: list[float] = []
    page.evaluate(COUNTS)
    yield found
    page.evaluate("window.counting = false")
    at: list[float] = page.evaluate("window.frames_")
    found += [after - before for before, after in pairwise(at)]


def rate(page: Page, act: Callable[[], object]) -> Numbers:
    """Do something again and again; return the frames a second, and the longest in milliseconds."""
    with counted(page) as frames:
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            act()
    return {"frames a second": 1000 * len(frames) / sum(frames), "longest frame, ms": max(frames)}


def measured(browser: Browser, url: str, places: int) -> Numbers:
    """Open the page of the trips, zoom, and move."""
    page = browser.new_page(viewport={"width": LAPTOP[0], "height": LAPTOP[1]})
    page.set_default_timeout(300_000)
    page.goto(f"{url}/#trips", wait_until="commit")
    numbers = {"opened, ms": float(page.evaluate(OPENED, places))}
    page.wait_for_load_state("networkidle")
    numbers["elements"] = page.evaluate("document.querySelectorAll('*').length")
    numbers["a pin moved, ms"] = page.evaluate(MOVED)
    page.get_by_role("button", name="Whole map").click()
    box = page.locator("svg.floor-picture").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    notches = cycle([*[-NOTCH] * NOTCHES, *[NOTCH] * NOTCHES])
    zoomed = rate(page, lambda: page.mouse.wheel(0, next(notches)))
    numbers.update({f"zooming, {name}": number for name, number in zoomed.items()})
    page.get_by_role("button", name="Whole map").click()
    page.mouse.move(x, y)
    for _ in range(NOTCHES // 2):
        page.mouse.wheel(0, -NOTCH)
    page.locator("svg.floor-picture").focus()
    keys = cycle(["ArrowLeft", "ArrowUp", "ArrowRight", "ArrowDown"])
    moved = rate(page, lambda: page.keyboard.press(next(keys)))
    numbers.update({f"moving, {name}": number for name, number in moved.items()})
    page.close()
    return numbers


def given_to(server: Server, places: int) -> None:
    """Give the station another plan."""
    revision = server.ask("/api/plan")["revision"]
    server.ask("/api/plan", {"revision": revision, "missions": plan(places)}, "PUT")


def main() -> None:
    """Measure some rounds, small and large in turn, and print the medians and their ratios."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--places", type=at_least_one, default=2000)
    parser.add_argument("--rounds", type=at_least_one, default=3)
    given = parser.parse_args()
    found: dict[str, dict[int, list[float]]] = defaultdict(lambda: defaultdict(list))
    with TemporaryDirectory() as name, sync_playwright() as driver:
        folder = Path(name)
        (folder / "fleet.toml").write_text(fleet(6), encoding="utf-8")
        server = serve([compiled(folder)], folder / "fleet.toml", folder / "station")
        browser = driver.chromium.launch(executable_path=chromium(), args=ARGUMENTS)
        try:
            for _ in range(given.rounds):
                for places in (FEW, given.places):
                    given_to(server, places)
                    for what, number in measured(browser, server.url, places).items():
                        found[what][places].append(number)
        finally:
            browser.close()
            server.end()
    print(f"{'':28}{FEW:>10} places{given.places:>10} places     ratio")
    for what, numbers in found.items():
        few, many = median(numbers[FEW]), median(numbers[given.places])
        print(f"{what:28}{few:17,.0f}{many:17,.0f}{many / few:10.2f}")


if __name__ == "__main__":
    main()
