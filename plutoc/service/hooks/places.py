"""Where hooks are in hooks.py, by its words alone: it is being typed, and may be no Python yet."""

from __future__ import annotations

import re

from plutoc.service.document import Document
from plutoc.source import Span

_WORD = re.compile(r"[^\W\d]\w*")


def definition_of(text: str, name: str) -> Span | None:
    """Return where a function of that name is defined, the last time."""
    pattern = rf"^(?:async[ \t]+)?def[ \t]+({re.escape(name)})\b"
    found = list(re.finditer(pattern, text, re.MULTILINE))
    return Span(*found[-1].span(1)) if found else None


def hook_at(document: Document, text: str, offset: int) -> str | None:
    """Return the hook whose name stands at a place of hooks.py."""
    hooks = {hook.name for hook in document.graph.hooks}
    hooks |= {action.name for action in document.graph.actions}
    for match in _WORD.finditer(text):
        if match.start() <= offset <= match.end() and match[0] in hooks:
            return match[0]
    return None
