"""What is to be known about a place of an app."""

from __future__ import annotations

from plutoc.service.answers import Hover
from plutoc.service.document import Document


def hover(document: Document, offset: int) -> Hover | None:
    """Return what is to be known about a place of the app's text."""
    return None
