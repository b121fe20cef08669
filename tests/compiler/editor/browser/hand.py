"""A hand at the mouse that counts its gestures: a click, a drag are one each."""

from __future__ import annotations

from dataclasses import dataclass

from playwright.sync_api import Locator, Page, expect

Target = Locator | tuple[float, float]


def middle(target: Target) -> tuple[float, float]:
    """Return the pixel in the middle of what is pointed at, once it rests: the drawing may glide."""
    if isinstance(target, tuple):
        return target
    target.scroll_into_view_if_needed()
    target.element_handle().wait_for_element_state("stable")
    box = target.bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@dataclass(slots=True)
class Hand:
    """A mouse over a page."""

    page: Page
    gestures: int = 0

    def click(self, target: Target) -> None:
        """Press and let go."""
        self.gestures += 1
        self.page.mouse.click(*middle(target))

    def drag(self, start: Target, end: Target) -> None:
        """Press, move as a hand does, let go."""
        self.gestures += 1
        x, y = middle(start)
        to = middle(end)
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + 9, y + 9, steps=2)
        self.page.mouse.move(*to, steps=8)
        self.page.mouse.move(*to)
        self.page.mouse.up()

    def add(self, kind: str) -> None:
        """Click a kind of block in the list: it is added behind what is selected."""
        blocks = self.page.locator(".block").count()
        self.click(self.page.locator(f'.kind-add[data-kind="{kind}"]'))
        expect(self.page.locator(".block")).to_have_count(blocks + 1)


def block(page: Page, name: str) -> Locator:
    """Return a block of the graph."""
    return page.locator(f'.block[data-block="{name}"]')


def port(page: Page, name: str, status: str = "all") -> Locator:
    """Return a port of a block: of a status, or of all."""
    return block(page, name).locator(f'.port[data-port="{status}"]')


def edge(page: Page, source: str, target: str) -> Locator:
    """Return the chips of an edge, on its middle."""
    return page.locator(f'.chip[data-edge^="{source}>{target}?"]')


def names(page: Page) -> list[str]:
    """Return all blocks, start and end included."""
    return [one.get_attribute("data-block") or "" for one in page.locator(".block").all()]


def statuses(page: Page, source: str, target: str) -> list[str]:
    """Return the statuses that an edge shows."""
    return edge(page, source, target).locator(".status").all_inner_texts()
