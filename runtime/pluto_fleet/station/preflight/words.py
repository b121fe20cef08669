"""The sentences of a forecast, for pages in any language."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..wire import Scalar, Words


def words(key: str, text: str, **facts: Scalar | list[str]) -> Words:
    """Return a sentence by the key of its translations, its facts, and the sentence in English."""
    return {"key": f"preflight.{key}", "facts": facts, "text": text}
