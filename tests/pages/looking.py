"""Looks at what is on the screen, by day and by night: as axe does, as a ruler does, and as a picture."""

from __future__ import annotations

from collections.abc import Callable

from playwright.sync_api import Page

from tests.kit.axe import COLOURS, violations
from tests.kit.browser import SCHEMES, Scheme
from tests.kit.layout import laid_out_badly
from tests.kit.pictures import picture
from tests.library.station.browser.steps import settled

SPEAK = """
async (language) => {
  const { speak } = await import("/pages/core/i18n.js");
  await speak(language);
}
"""


def looked_at(page: Page, keep: Callable[[Scheme, bytes], object] | None = None) -> list[str]:
    """Return what is wrong with what is on the screen; `keep` is given a picture for each scheme.

    By night only colours can be wrong that were right by day.
    """
    found: list[str] = []
    for scheme in SCHEMES:
        # nothing is caught half-way
        page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
        settled(page)
        if keep is not None:  # first: a page stands still as long as axe looks at it
            keep(scheme, picture(page))
        found += violations(page, None if scheme == SCHEMES[0] else COLOURS)
    return [*found, *laid_out_badly(page)]


def in_language(page: Page, language: str, look: Callable[[], list[str]]) -> list[str]:
    """Look in another language, and go back to English, in which people's steps are written."""
    page.evaluate(SPEAK, language)
    settled(page)
    found = look()
    page.evaluate(SPEAK, "en")
    settled(page)
    return found
