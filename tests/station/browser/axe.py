"""Asks axe-core, as it comes in a package, what is wrong with a page for people who cannot see it."""

from __future__ import annotations

import json
from importlib.resources import files
from typing import Any

from playwright.sync_api import Page

STANDARDS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]
SCRIPT = files("axe_playwright_python").joinpath("axe.min.js").read_text(encoding="utf-8")


def violations(page: Page) -> list[str]:
    """Return the violations of WCAG A and AA, each with the elements that it is seen at."""
    page.evaluate(SCRIPT)
    only = {"type": "tag", "values": STANDARDS}
    # It would fetch imported style sheets from where they are not, and put them inline.
    asked = json.dumps({"runOnly": only, "preload": False})
    found: list[dict[str, Any]] = page.evaluate(
        f"async () => (await axe.run(document, {asked})).violations"
    )
    return [
        f"{one['id']}: {node['target']} {node['html'][:200]} {node.get('failureSummary', '')}"
        for one in found
        for node in one["nodes"]
    ]
