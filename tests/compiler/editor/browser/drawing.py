"""What is drawn in several tests: blocks put between, wires taken elsewhere, names given."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from tests.compiler.editor.browser.hand import Hand, block, edge, port


def rename(page: Page, name: str, new: str) -> None:
    """Give a block another name, in its properties."""
    block(page, name).locator(".face").click()
    field = page.get_by_label("Name", exact=True)
    expect(field).to_have_value(name)
    field.fill(new)
    field.press("Enter")
    expect(block(page, new)).to_be_visible()


def put_between(page: Page, kind: str, source: str, target: str) -> None:
    """Drag a kind of block from the list onto an edge."""
    hand = Hand(page)
    blocks = page.locator(".block").count()
    hand.drag(page.locator(f'.kind-add[data-kind="{kind}"]'), edge(page, source, target))
    expect(page.locator(".block")).to_have_count(blocks + 1)


def lead(page: Page, source: str, target: str, end: str, to: str) -> None:
    """Take one end of an edge to another block."""
    edge(page, source, target).click()
    handle = page.locator(f'.handle[data-end="{end}"]')
    expect(handle).to_be_visible()
    Hand(page).drag(handle, block(page, to))
    ends = (to, target) if end == "source" else (source, to)
    expect(edge(page, *ends)).to_be_visible()


def add_from_port(page: Page, source: str, status: str, kind: str, name: str) -> None:
    """Draw a wire into the open, and choose what stands at its end."""
    start = port(page, source, status)
    box = start.bounding_box()
    assert box is not None
    ground = page.locator(".viewport").bounding_box()
    assert ground is not None
    Hand(page).drag(start, (ground["x"] + ground["width"] - 60, box["y"] + 40))
    page.get_by_role("combobox", name=f"Add a block behind {source}").fill(kind)
    page.keyboard.press("Enter")
    expect(block(page, name)).to_be_visible()


def complete(page: Page, begun: str, whole: str) -> None:
    """Type the beginning of a name, and take it from the list."""
    page.keyboard.insert_text(begun[:-1])
    page.keyboard.type(begun[-1])
    found = page.locator(".cm-tooltip-autocomplete li[aria-selected]", has_text=whole)
    found.click()
    expect(found).to_be_hidden()
