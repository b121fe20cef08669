"""Every page in every phase, by day and by night, in three languages, on screens of all sizes.

`pytest tests/library/station/browser/test_every_page.py -m "long or not long" --update` takes the pictures of
docs/station.md anew; `python -m tests.library.station.browser.every_page` looks at all sizes in all languages.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import cycle
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.kit.browser import Scheme, Watch
from tests.kit.station import App, Station
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.crowd import crowded_station
from tests.library.station.browser.looking import SCHEMES, in_language, looked_at
from tests.library.station.browser.pictures import FOLDER, kept
from tests.library.station.browser.scenes import BREAKS, a_flight, crowded, heat, scenes
from tests.library.station.browser.steps import settled
from tests.release.environments import ROOT

SHOWN = ("empty-missions", "missions", "trips", "monitor", "results", "history", "map", "help")
"""What the docs have pictures of."""

SIZES = {"laptop": (1366, 768), "phone": (390, 844)}
SMALLER = (360, 740)
SMALL = 100_000
"""Bytes of a picture."""

OTHERS = ("it", "de")
Scenes = Callable[[Page, Station], Iterator[str]]


def look_through(
    page: Page, station: Station, play: Scenes, device: str = "", *, update: bool = False
) -> None:
    """Look at each scene, in English and in one of the other languages."""
    wrong: dict[str, list[str]] = {}
    for scene, other in zip(play(page, station), cycle(OTHERS), strict=False):

        def keep(scheme: Scheme, taken: bytes, scene: str = scene) -> None:
            assert len(taken) < SMALL, scene
            if update and device:
                FOLDER.mkdir(exist_ok=True)
                kept(f"{scene}-{device}-{scheme}").write_bytes(taken)

        found = looked_at(page, keep if scene in SHOWN else None)
        if device == "phone":
            found += smaller(page)
        if device != "laptop":
            found += in_language(page, other, lambda: looked_at(page))
        if found:
            wrong[scene] = found
    assert wrong == {}


def smaller(page: Page) -> list[str]:
    """Look at the same on a screen that is smaller still."""
    page.set_viewport_size({"width": SMALLER[0], "height": SMALLER[1]})
    settled(page)
    found = looked_at(page)
    page.set_viewport_size({"width": SIZES["phone"][0], "height": SIZES["phone"][1]})
    settled(page)
    return found


@pytest.mark.first
def test_every_page_in_every_phase_can_be_seen_and_pressed_and_read_aloud(
    serve: Serve, visit: Visit, update: bool
) -> None:
    """Nothing lies over anything, all words fit, and axe finds no violation of WCAG A or AA."""
    station = serve("drugs_distribution", "--speed", "5")
    page = visit(station, size=SIZES["laptop"])
    look_through(page, station, a_flight, "laptop", update=update)


@pytest.mark.long  # minutes
def test_the_same_on_a_phone_and_when_the_station_breaks(
    serve: Serve, visit: Visit, watch: Watch, update: bool
) -> None:
    """A thumb hits everything, and nothing scrolls to the side, in any language."""
    watch.expected += BREAKS
    station = serve("drugs_distribution", "--speed", "5")
    page = visit(station, size=SIZES["phone"], touch=True)
    look_through(page, station, scenes, "phone", update=update)


@pytest.mark.long  # minutes
def test_the_same_on_a_large_screen(serve: Serve, visit: Visit, watch: Watch) -> None:
    watch.expected += BREAKS
    station = serve("drugs_distribution", "--speed", "5")
    page = visit(station, size=(1920, 1080))
    look_through(page, station, scenes)


@pytest.mark.long  # a whole flight, twice
@pytest.mark.parametrize("device", SIZES)
def test_what_was_measured_is_seen_over_the_whole_map(
    serve: Serve, visit: Visit, device: str, update: bool
) -> None:
    missions = ("--missions", str(ROOT / "examples" / "pm10" / "missions.toml"))
    station = serve("pm10", *missions, "--speed", "60")
    page = visit(station, size=SIZES[device], touch=device == "phone")
    look_through(page, station, heat, device, update=update)


@pytest.mark.long  # fifty drones in the air
@pytest.mark.parametrize("device", SIZES)
def test_a_crowd_of_drones_and_missions_stays_readable(
    apps: dict[str, App], tmp_path: Path, visit: Visit, device: str
) -> None:
    """Fifty drones and two hundred missions: no name covers another, and what is lost is named."""
    with crowded_station(apps["drugs_distribution"], tmp_path) as crowd:
        page = visit(crowd, size=SIZES[device], touch=device == "phone")
        look_through(page, crowd, crowded)
        page.goto("about:blank")  # before its station ends


def test_the_docs_show_every_picture_and_no_other() -> None:
    page = (ROOT / "docs" / "station.md").read_text()
    named = set(re.findall(r"\(station/([a-z-]+)\.png\)", page))
    wanted = {f"{scene}-{on}-{by}" for scene in SHOWN for on in SIZES for by in SCHEMES}
    assert named == wanted
    assert {path.stem for path in FOLDER.glob("*.png")} == wanted
    assert all(path.stat().st_size < SMALL for path in FOLDER.glob("*.png"))
