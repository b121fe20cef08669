"""The pages in each language: chosen on Help, and loaded alone; `python -m tests.pages` looks at them all."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tests.kit.station import Station
from tests.library.station.browser.conftest import Visit
from tests.library.station.browser.steps import open_page

pytestmark = pytest.mark.long

ITALIAN = ("Missioni", "Tratte", "Monitor", "Risultati", "Storico", "Mappa", "Aiuto")


def test_a_language_is_chosen_and_every_page_speaks_it(ward: Station, visit: Visit) -> None:
    """It is remembered in this browser."""
    page = visit(ward)
    open_page(page, "Help")
    page.get_by_label("Language").select_option("it")
    expect(page.locator("html")).to_have_attribute("lang", "it")
    tabs = page.locator(".head > .tabs").get_by_role("tab")
    expect(tabs).to_have_text(ITALIAN)
    page.reload()
    expect(tabs).to_have_text(ITALIAN)


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
