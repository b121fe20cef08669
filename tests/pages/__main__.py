"""`python -m tests.pages`: look at every page in every phase, size, scheme and language.

Pictures of all of it are kept in a folder; what lies over something else, sticks out, is cut off, or is a
violation of WCAG A or AA, is printed, and fails the campaign.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.paths import EXAMPLES, ROOT

sys.path.append(str(ROOT / "benchmarks"))  # the crowd is that of a benchmark

from playwright.sync_api import Browser, Page, expect, sync_playwright

from tests.apart import apart
from tests.kit.browser import A_STEP, ARGUMENTS, Scheme, chromium
from tests.kit.station import Station, Stations
from tests.pages.crowd import crowded_station
from tests.pages.looking import in_language, looked_at
from tests.pages.scenes import Scenes, crowded, heat, scenes

SIZES = ("360x740", "390x844", "1366x768", "1920x1080")
LANGUAGES = ("en", "it", "de")
PHONE = 760
"""Pixels of width below which a screen is touched."""


class Matrix:
    """All looks of one run, and what was wrong."""

    def __init__(self, browser: Browser, folder: Path, languages: list[str]) -> None:
        self._browser, self._folder, self._languages = browser, folder, languages
        self.looks = 0
        self.wrong: list[str] = []

    def look(self, station: Station, play: Scenes, size: str) -> None:
        """Lead a page of this size through scenes, and look at each in all languages."""
        width, height = (int(pixels) for pixels in size.split("x"))
        context = self._browser.new_context(
            viewport={"width": width, "height": height}, has_touch=width < PHONE
        )
        context.set_default_timeout(A_STEP)
        page = context.new_page()
        page.on("pageerror", lambda error: self.wrong.append(f"{size}: {error}"))
        page.goto(station.url)
        for scene in play(page, station):
            for language in self._languages:
                self._look(page, f"{scene}-{size}-{language}", language)
        context.close()

    def _look(self, page: Page, name: str, language: str) -> None:
        def keep(scheme: Scheme, taken: bytes) -> None:
            self.looks += 1
            (self._folder / f"{name}-{scheme}.png").write_bytes(taken)

        for one in in_language(page, language, lambda: looked_at(page, keep)):
            self.wrong.append(f"{name}: {one}")
            print(self.wrong[-1], flush=True)


def served(stations: Stations) -> Iterator[tuple[Station, Scenes]]:
    """Serve one station after another, each with the scenes that it is for."""
    missions = str(EXAMPLES / "pm10" / "missions.toml")
    for station, play in (
        (stations.fresh("drugs_distribution", "--speed", "2"), scenes),
        (stations.fresh("pm10", "--missions", missions, "--speed", "60"), heat),
        (crowded_station(stations), crowded),
    ):
        station.start()
        try:
            yield station, play
        finally:
            station.end()


def main() -> int:
    """Run the campaign."""
    parser = ArgumentParser(prog="python -m tests.pages", description=__doc__)
    parser.add_argument("--sizes", nargs="+", default=SIZES, help="of the screens")
    parser.add_argument("--languages", nargs="+", choices=LANGUAGES, default=LANGUAGES)
    parser.add_argument("--pictures", type=Path, default=Path("every-page"), help="their folder")
    given = parser.parse_args()
    given.pictures.mkdir(parents=True, exist_ok=True)
    expect.set_options(timeout=A_STEP)
    with TemporaryDirectory() as temporary, apart(), sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium(), args=ARGUMENTS)
        matrix = Matrix(browser, given.pictures, list(given.languages))
        stations = Stations(Path(temporary))
        for size in given.sizes:
            for station, play in served(stations):
                matrix.look(station, play, size)
        browser.close()
    print(f"{matrix.looks} looks, {len(matrix.wrong)} of them wrong; pictures in {given.pictures}")
    return 1 if matrix.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
