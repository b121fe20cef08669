"""Completion and hover in hooks.py: what missions, trips, drones and the rest offer.

It is being typed, and need not be Python yet: nothing is run, and nothing parsed as a whole.
"""

from __future__ import annotations

from plutoc.service.answers import Hover, Item
from plutoc.service.document import Document


def complete(document: Document, text: str, offset: int) -> tuple[Item, ...]:
    """Return what may stand at a place of the text of an app's hooks.py."""
    return ()


def hover(document: Document, text: str, offset: int) -> Hover | None:
    """Return what is to be known about a place of the text of an app's hooks.py."""
    return None
