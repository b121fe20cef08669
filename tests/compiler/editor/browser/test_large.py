"""Three hundred blocks: they are seen, found, moved and tidied. How fast: `python benchmarks/graph_editor.py`."""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from tests.compiler.editor.browser.conftest import Edit, Visit
from tests.compiler.editor.browser.hand import Hand, block
from tests.compiler.editor.browser.large import large
from tests.compiler.editor.browser.scenes import COLOURS, FOLDER
from tests.kit.browser import DESKTOP
from tests.kit.pictures import kept, picture
from tests.kit.station import until

BLOCKS = 300


@pytest.mark.long
def test_three_hundred_blocks(edit: Edit, visit: Visit, update: bool) -> None:
    editor = edit(text=large())
    page = visit(editor, size=DESKTOP)
    expect(page.locator(".block")).to_have_count(BLOCKS + 2)
    expect(page.locator(".minimap")).to_be_visible()
    # one of the outline is brought into sight
    page.get_by_role("option", name="allocate_9", exact=False).first.click()
    expect(block(page, "allocate_9")).to_be_in_viewport()
    if update:
        page.emulate_media(reduced_motion="reduce")
        kept(FOLDER, "large").write_bytes(picture(page, COLOURS))
    before = block(page, "allocate_9").bounding_box()
    assert before is not None
    Hand(page).drag(block(page, "allocate_9").locator(".face"), (before["x"] + 40, before["y"]))
    layout = editor.file.with_name("drugs.pluto.layout")
    until(lambda: layout.exists() and "allocate_9" in layout.read_text(), "it is kept")
    page.get_by_role("button", name="Tidy").click()
    until(lambda: not layout.exists() or not layout.read_text(), "it is forgotten")
    page.keyboard.press("F6")
    percent = page.locator(".percent")
    for key, shown in (("0", "100 %"), ("-", "80 %"), ("+", "100 %")):
        page.keyboard.press(key)
        expect(percent).to_have_text(shown)
    page.keyboard.press("f")
    expect(percent).not_to_have_text("100 %")
