"""Every page in every phase, by day and by night, in three languages, on a laptop and on a phone.

`pytest tests/library/station/browser/test_every_page.py -m "long or not long" --update` takes the pictures of
docs/station.md anew; `python -m tests.pages` looks at all sizes in all languages.
"""

from __future__ import annotations

import re
from itertools import cycle

import pytest
from playwright.sync_api import Page

from tests.kit.browser import BREAKS, LAPTOP, PHONE, SCHEMES, Scheme, Watch
from tests.kit.pictures import kept
from tests.kit.station import Station
from tests.library.station.browser.conftest import Serve, Visit
from tests.pages.looking import in_language, looked_at
from tests.pages.scenes import Scenes, a_flight, heat, pursuit, scenes
from tests.paths import EXAMPLES, ROOT

SHOWN = (
    "empty-missions",
    "missions",
    "trips",
    "monitor",
    "events",
    "results",
    "history",
    "map",
    "help",
)
"""What the docs have pictures of."""

FOLDER = ROOT / "docs" / "station"
SIZES = {"laptop": LAPTOP, "phone": PHONE}
SMALL = 100_000
"""Bytes of a picture."""

OTHERS = ("it", "de")


def look_through(page: Page, station: Station, play: Scenes, device: str, update: bool) -> None:
    """Look at each scene, on a phone in one of the other languages, too."""
    wrong: dict[str, list[str]] = {}
    for scene, other in zip(play(page, station), cycle(OTHERS), strict=False):

        def keep(scheme: Scheme, taken: bytes, scene: str = scene) -> None:
            assert len(taken) < SMALL, scene
            if update:
                kept(FOLDER, f"{scene}-{device}-{scheme}").write_bytes(taken)

        found = looked_at(page, keep if scene in SHOWN else None)
        if device == "phone":
            found += in_language(page, other, lambda: looked_at(page))
        if found:
            wrong[scene] = found
    assert wrong == {}


@pytest.mark.long  # minutes
@pytest.mark.first
@pytest.mark.parametrize("device", SIZES)
def test_every_page_in_every_phase_can_be_seen_and_pressed_and_read_aloud(
    serve: Serve, visit: Visit, watch: Watch, device: str, update: bool
) -> None:
    """Nothing lies over anything, all words fit, and axe finds no violation; on a phone the station breaks, too."""
    watch.expected += BREAKS
    station = serve("drugs_distribution", "--speed", "5", own=True)
    page = visit(station, size=SIZES[device], touch=device == "phone")
    look_through(page, station, scenes if device == "phone" else a_flight, device, update)


@pytest.mark.long  # a whole flight, twice
@pytest.mark.parametrize("device", SIZES)
def test_what_was_measured_is_seen_over_the_whole_map(
    serve: Serve, visit: Visit, device: str, update: bool
) -> None:
    missions = ("--missions", str(EXAMPLES / "pm10" / "missions.toml"))
    station = serve("pm10", *missions, "--speed", "60", own=True)
    page = visit(station, size=SIZES[device], touch=device == "phone")
    look_through(page, station, heat, device, update)


@pytest.mark.long  # a flight, twice
@pytest.mark.parametrize("device", SIZES)
def test_what_moves_and_what_happens_is_seen_live_and_in_a_replay(
    serve: Serve, visit: Visit, device: str, update: bool
) -> None:
    missions = ("--missions", str(EXAMPLES / "pursue" / "missions.toml"))
    station = serve("pursue", *missions, "--speed", "3", own=True)
    page = visit(station, size=SIZES[device], touch=device == "phone")
    look_through(page, station, pursuit, device, update)


def test_the_docs_show_every_picture_and_no_other() -> None:
    page = (ROOT / "docs" / "station.md").read_text()
    named = set(re.findall(r"\(station/([a-z-]+)\.png\)", page))
    wanted = {f"{scene}-{on}-{by}" for scene in SHOWN for on in SIZES for by in SCHEMES}
    assert named == wanted
    assert {path.stem for path in FOLDER.glob("*.png")} == wanted
    assert all(path.stat().st_size < SMALL for path in FOLDER.glob("*.png"))
