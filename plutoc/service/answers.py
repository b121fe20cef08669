"""What the service answers to an editor: plain values, with places in characters of the text."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from plutoc.source import Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Hover:
    """What is to be known about a place, in Markdown, and the stretch that it is about."""

    markdown: str
    span: Span


class Sort(Enum):
    """What a completion is, for its picture in a list."""

    KEYWORD = "keyword"
    BLOCK = "block"
    KIND = "kind"
    PACKAGE = "package"
    CATEGORY = "category"
    HOOK = "hook"
    PARAMETER = "parameter"
    VALUE = "value"
    UNIT = "unit"
    STATUS = "status"
    TYPE = "type"
    STATEMENT = "statement"
    ATTRIBUTE = "attribute"
    METHOD = "method"


@dataclass(frozen=True, slots=True, kw_only=True)
class Item:
    """A completion: what to show, and what to put in place of the span."""

    label: str
    insert: str
    span: Span
    kind: Sort
    detail: str = ""
    """A few words, beside the label."""
    doc: str = ""
    """Markdown."""
