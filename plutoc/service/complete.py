"""What can be written at a place of an app: only what is legal there, the likeliest first."""

from __future__ import annotations

from plutoc.service.answers import Item
from plutoc.service.document import Document


def complete(document: Document, offset: int) -> tuple[Item, ...]:
    """Return what may stand at a place of the app's text, the likeliest first."""
    return ()
