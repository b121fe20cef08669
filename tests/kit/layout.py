"""What a person sees at a glance, and a program can say: nothing lies over anything, all can be hit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from playwright.sync_api import Page

SCRIPT = Path(__file__).with_suffix(".js").read_text(encoding="utf-8")

LEAST_MAP = 0.45
"""Of the screen, on the Monitor, where the screen is as wide as a laptop's."""
WIDE, NARROW = 1366, 760


def measured(page: Page, what: str, *given: float) -> Any:
    """Return what one of the script's functions says of a page."""
    return page.evaluate(f"(given) => ({SCRIPT}).{what}(...given)", list(given))


def wider_than_the_screen(page: Page) -> int:
    """Return by how many pixels one must scroll to the side."""
    wider: int = page.evaluate("() => document.documentElement.scrollWidth - innerWidth")
    return max(0, wider)


def covered(page: Page) -> list[str]:
    """Return what could be pressed, and has something else above its middle."""
    found: list[str] = measured(page, "covered")
    return found


def too_small(page: Page, least: float, thumb: float = 0) -> list[str]:
    """Return what a finger would miss; where a thumb acts, it may ask for more."""
    found: list[str] = measured(page, "smallTargets", least, max(least, thumb))
    return found


def cut_off(page: Page) -> list[str]:
    """Return the words that do not fit where they stand."""
    found: list[str] = measured(page, "cutOff")
    return found


def sideways(page: Page) -> list[str]:
    """Return the lists that scroll to the side."""
    found: list[str] = measured(page, "sideways")
    return found


def laid_out_badly(page: Page) -> list[str]:
    """Return all that a person would stumble over; fingers need more room than a mouse."""
    found = [*covered(page), *cut_off(page), *sideways(page)]
    found += measured(page, "sticksOut") + measured(page, "names")
    if wide := wider_than_the_screen(page):
        found.append(f"{wide} pixels wider than the screen")
    width = page.viewport_size["width"] if page.viewport_size else 0
    if width <= NARROW:
        found += too_small(page, 24, 38)
    share: float = measured(page, "mapShare")
    if width >= WIDE and share < LEAST_MAP:
        found.append(f"the map takes {share:.0%} of the Monitor")
    return found
