"""Looks at every page of the station in every phase, in all sizes, schemes and languages; needs Chromium.

    python -m tests.pages --sizes 360x740

Pictures of all of it are kept in a folder; what lies over something else, sticks out, is cut off, or is a
violation of WCAG A or AA, is printed, and fails the campaign. All sizes take some twenty minutes.
"""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import Browser, expect, sync_playwright

from tests.apart import apart
from tests.kit.browser import A_STEP, ARGUMENTS, Scheme, chromium
from tests.kit.campaign import Campaign
from tests.kit.station import Station, Stations
from tests.pages.looking import in_language, looked_at
from tests.pages.scenes import Scenes, heat, pursuit, scenes
from tests.paths import EXAMPLES

SIZES = ("360x740", "390x844", "1366x768", "1920x1080")
LANGUAGES = ("en", "it", "de")
PHONE = 760
"""Pixels of width below which a screen is touched."""


def look_through(
    browser: Browser, station: Station, play: Scenes, size: str, given: Namespace
) -> list[str]:
    """Lead a page of this size through scenes, and look at each in all languages."""
    wrong: list[str] = []
    width, height = (int(pixels) for pixels in size.split("x"))
    context = browser.new_context(
        viewport={"width": width, "height": height}, has_touch=width < PHONE
    )
    context.set_default_timeout(A_STEP)
    page = context.new_page()
    page.on("pageerror", lambda error: wrong.append(f"{size}: {error}"))
    page.goto(station.url)
    for scene in play(page, station):
        for language in given.languages:
            name = f"{scene}-{size}-{language}"

            def keep(scheme: Scheme, taken: bytes, name: str = name) -> None:
                (given.pictures / f"{name}-{scheme}.png").write_bytes(taken)

            found = in_language(page, language, lambda: looked_at(page, keep))
            wrong += [f"{name}: {one}" for one in found]
    context.close()
    return wrong


def served(stations: Stations) -> Iterator[tuple[Station, Scenes]]:
    """Serve one station after another, each with the scenes that it is for."""
    missions = str(EXAMPLES / "pm10" / "missions.toml")
    patrols = str(EXAMPLES / "pursue" / "missions.toml")
    for station, play in (
        (stations.fresh("drugs_distribution", "--speed", "2"), scenes),
        (stations.fresh("pm10", "--missions", missions, "--speed", "60"), heat),
        (stations.fresh("pursue", "--missions", patrols, "--speed", "3"), pursuit),
    ):
        station.start()
        try:
            yield station, play
        finally:
            station.end()


def main() -> int:
    """Run the campaign."""
    campaign = Campaign("tests.pages", __doc__)
    campaign.unit = "size"
    campaign.option("--sizes", nargs="+", default=SIZES, help="of the screens")
    campaign.option("--languages", nargs="+", choices=LANGUAGES, default=LANGUAGES)
    campaign.option("--pictures", type=Path, default=Path("every-page"), help="their folder")
    given = campaign.parse()
    given.pictures.mkdir(parents=True, exist_ok=True)
    expect.set_options(timeout=A_STEP)
    with TemporaryDirectory() as temporary, apart(), sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium(), args=ARGUMENTS)
        stations = Stations(Path(temporary))

        def one(size: str) -> list[str]:
            wrong: list[str] = []
            for station, play in served(stations):
                wrong += look_through(browser, station, play, size, given)
            return wrong

        for size, wrong in campaign.each(one, given.sizes):
            if wrong:
                campaign.found(size, *wrong)
        browser.close()
    return campaign.over(f"the pictures are in {given.pictures}")


if __name__ == "__main__":
    sys.exit(main())
