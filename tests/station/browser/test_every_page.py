"""Every page in every phase, by day and by night, on a laptop and a tablet.

`pytest tests/station/browser/test_every_page.py --update` takes the pictures of docs/station.md anew.
"""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page

from tests.release.environments import ROOT
from tests.station.browser.axe import violations
from tests.station.browser.conftest import LAPTOP, TABLET, Scheme, Serve, Visit
from tests.station.browser.layout import covered, cut_off, too_small, wider_than_the_screen
from tests.station.browser.pictures import FOLDER, kept, picture
from tests.station.browser.scenes import scenes
from tests.station.browser.steps import settled

SHOWN = ("empty-missions", "missions", "trips", "monitor", "help")
"""What the docs have pictures of."""

SIZES = {"laptop": LAPTOP, "tablet": TABLET}
SCHEMES: tuple[Scheme, ...] = ("light", "dark")
SMALL = 100_000
"""Bytes of a picture."""


@pytest.mark.parametrize(
    "device",
    [
        # half a minute each
        pytest.param(device, marks=[] if device == "laptop" else [pytest.mark.long])
        for device in SIZES
    ],
)
def test_every_page_in_every_phase_can_be_seen_and_pressed_and_read_aloud(
    serve: Serve, visit: Visit, device: str, update: bool
) -> None:
    """Nothing lies over anything, all words fit, and axe finds no violation of WCAG A or AA."""
    station = serve("drugs_distribution", "--speed", "5")
    page = visit(station, size=SIZES[device], touch=device == "tablet")
    wrong: dict[tuple[str, Scheme], list[str]] = {}
    for scene in scenes(page, station):
        for scheme in SCHEMES:
            # nothing is caught half-way
            page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
            settled(page)
            wrong[scene, scheme] = [*violations(page), *laid_out_badly(page, device)]
            if scene in SHOWN:
                taken = picture(page)
                assert len(taken) < SMALL, scene
                if update:
                    FOLDER.mkdir(exist_ok=True)
                    kept(f"{scene}-{device}-{scheme}").write_bytes(taken)
    assert {where: said for where, said in wrong.items() if said} == {}


def laid_out_badly(page: Page, device: str) -> list[str]:
    """Return what a person would stumble over; fingers need more room than a mouse."""
    said = [*covered(page), *cut_off(page)]
    if device == "tablet":
        said += too_small(page, 38)
    if wide := wider_than_the_screen(page):
        said.append(f"{wide} pixels wider than the screen")
    return said


def test_the_docs_show_every_picture_and_no_other() -> None:
    page = (ROOT / "docs" / "station.md").read_text()
    named = set(re.findall(r"\(station/([a-z-]+)\.png\)", page))
    wanted = {f"{scene}-{on}-{by}" for scene in SHOWN for on in SIZES for by in SCHEMES}
    assert named == wanted
    assert {path.stem for path in FOLDER.glob("*.png")} == wanted
    assert all(path.stat().st_size < SMALL for path in FOLDER.glob("*.png"))
