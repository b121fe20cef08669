"""The sentences of the station that each page says in its own language."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .wire import SaidKey, Scalar, Words


def words(key: SaidKey, text: str, **facts: Scalar | list[str]) -> Words:
    """Return a sentence by the key of its translations, its facts, and the sentence in English."""
    return {"key": key, "facts": facts, "text": text}
