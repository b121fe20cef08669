"""The pages in each language: chosen on Help, loaded alone, and fitting the same buttons."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.kit.station import Station
from tests.library.station.browser.axe import violations
from tests.library.station.browser.conftest import Visit
from tests.library.station.browser.exercise import put_in
from tests.library.station.browser.layout import covered, cut_off, wider_than_the_screen
from tests.library.station.browser.steps import open_page, settled

TABS = {
    "it": ("Missioni", "Tratte", "Monitor", "Risultati", "Storico", "Mappa", "Aiuto"),
    "de": ("Missionen", "Etappen", "Monitor", "Ergebnisse", "Verlauf", "Karte", "Hilfe"),
}
PHONE = (360, 740)

OFF_THE_SCREEN = """
() => [...document.querySelectorAll(".fly button")]
  .filter((one) => one.getBoundingClientRect().right > innerWidth).map((one) => one.outerHTML)
"""


def choose(page: Page, language: str) -> None:
    """Choose a language on Help, and wait until the page speaks it."""
    open_page(page, "Help")
    page.get_by_label("Language").select_option(language)
    expect(page.locator("html")).to_have_attribute("lang", language)


def laid_out_badly(page: Page) -> list[str]:
    """Return what does not fit; the title is the app's own, and may be cut."""
    said = [one for one in cut_off(page) if 'class="title"' not in one]
    off: list[str] = page.evaluate(OFF_THE_SCREEN)
    if wide := wider_than_the_screen(page):
        said.append(f"{wide} pixels wider than the screen")
    return said + off


@pytest.mark.parametrize("language", sorted(TABS))
def test_a_language_is_chosen_and_every_page_speaks_it(
    ward: Station, visit: Visit, language: str
) -> None:
    """Tabs and numbers are those of the language; on a phone all fits, and axe finds nothing."""
    page = visit(put_in(ward))
    choose(page, language)
    tabs = page.locator(".head > .tabs").get_by_role("tab")
    expect(tabs).to_have_text(TABS[language])
    tabs.nth(1).click()
    page.get_by_role("button", name="Mission 1").click()
    expect(page.locator(".pin").first).to_have_attribute("aria-label", re.compile("3; 8,5"))
    page.set_viewport_size({"width": PHONE[0], "height": PHONE[1]})
    wrong = {}
    for n, tab in enumerate(TABS[language]):
        tabs.nth(n).click()
        settled(page)
        wrong[tab] = [*covered(page), *laid_out_badly(page), *violations(page)]
    assert {tab: said for tab, said in wrong.items() if said} == {}


def test_who_reads_german_loads_no_other_language(ward: Station, visit: Visit) -> None:
    """The texts of the browser's language are asked for, alone."""
    asked: list[str] = []

    def listen(page: Page) -> None:
        page.on("request", lambda request: asked.append(request.url))
        page.add_init_script(
            "Object.defineProperty(navigator, 'languages', { value: ['de-AT', 'en'] })"
        )

    page = visit(ward, prepare=listen)
    expect(page.get_by_role("tab", name="Hilfe")).to_be_visible()
    assert [url.rsplit("/", 1)[1] for url in asked if "/texts/" in url] == ["de.js"]
