"""Asks axe-core, as it comes in a package, what is wrong with a page for people who cannot see it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from importlib.resources import files
from typing import Any

from playwright.sync_api import Page

STANDARDS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]
SCRIPT = files("axe_playwright_python").joinpath("axe.min.js").read_text(encoding="utf-8")


COLOURS = ["color-contrast"]
"""The rule that depends on whether it is day or night."""


def violations(page: Page, rules: Sequence[str] | None = None) -> list[str]:
    """Return the violations of WCAG A and AA, or of these rules, each with the elements that it is seen at."""
    if not page.evaluate("() => 'axe' in window"):
        page.evaluate(SCRIPT)
    only = (
        {"type": "tag", "values": STANDARDS} if rules is None else {"type": "rule", "values": rules}
    )
    # It would fetch imported style sheets from where they are not, and put them inline.
    asked = json.dumps({"runOnly": only, "preload": False, "resultTypes": ["violations"]})
    found: list[dict[str, Any]] = page.evaluate(
        f"async () => (await axe.run(document, {asked})).violations"
    )
    return [
        f"{one['id']}: {node['target']} {node['html'][:200]} {node.get('failureSummary', '')}"
        for one in found
        for node in one["nodes"]
    ]
