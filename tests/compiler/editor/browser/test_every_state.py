"""Every state of the editor, by day and by night, on a laptop and on a desk.

`pytest tests/compiler/editor/browser/test_every_state.py --update` takes the pictures of docs/graph-editor.md anew.
"""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import expect

from tests.compiler.editor.browser.conftest import Edit, Visit
from tests.compiler.editor.browser.scenes import COLOURS, FOLDER, scenes
from tests.kit.axe import violations
from tests.kit.browser import DESKTOP, LAPTOP, SCHEMES, Scheme
from tests.kit.layout import cut_off, wider_than_the_screen
from tests.kit.pictures import kept, picture
from tests.paths import ROOT

SHOWN: dict[str, Scheme] = {
    "empty": "light",
    "graph": "light",
    "block": "dark",
    "wiring": "light",
    "problems": "light",
    "hooks": "light",
    "compile": "light",
    "run": "dark",
}
"""What the docs have pictures of, and by which light."""

SIZES = {"laptop": LAPTOP, "desk": DESKTOP}
SMALL = 150_000
"""Bytes of a picture."""


@pytest.mark.long  # half a minute each
@pytest.mark.parametrize("device", SIZES)
def test_no_state_breaks_wcag_a_or_aa(edit: Edit, visit: Visit, device: str, update: bool) -> None:
    """Axe finds no violation, nothing is cut off, and nothing asks another machine."""
    wrong: dict[tuple[str, Scheme], list[str]] = {}
    for scene, page in scenes(edit, visit, SIZES[device]):
        for scheme in SCHEMES:
            # nothing is caught half-way
            page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
            found = [*violations(page), *cut_off(page)]
            if wide := wider_than_the_screen(page):
                found.append(f"{wide} pixels wider than the screen")
            wrong[scene, scheme] = found
            if device == "laptop" and SHOWN.get(scene) == scheme:
                taken = picture(page, COLOURS)
                assert len(taken) < SMALL, (scene, len(taken))
                if update:
                    kept(FOLDER, scene).write_bytes(taken)
        page.emulate_media(color_scheme="light", reduced_motion="no-preference")
    assert {where: said for where, said in wrong.items() if said} == {}


def test_the_docs_show_every_picture_and_no_other() -> None:
    page = (ROOT / "docs" / "graph-editor.md").read_text()
    assert set(re.findall(r"\(graph-editor/([a-z-]+)\.png\)", page)) == {*SHOWN, "large"}
    assert {path.stem for path in FOLDER.glob("*.png")} == {*SHOWN, "large"}


@pytest.mark.long
def test_an_explanation_that_scrolls_is_reached_by_keyboard(edit: Edit, visit: Visit) -> None:
    """One that the mouse has called up is read to its end without a mouse, too."""
    page = visit(edit("alfalfa"))
    page.locator(".cm-line", has_text="DroneAllocator").get_by_text("DroneAllocator").hover()
    explanation = page.locator(".explanation")
    expect(explanation).to_be_visible()
    assert explanation.evaluate("element => element.scrollHeight > element.clientHeight")
    assert violations(page) == []
