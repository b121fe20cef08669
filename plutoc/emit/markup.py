"""Free text in TOML and in Markdown: what a user wrote stays text."""

from __future__ import annotations

import re

_MARKS = re.compile(r"[\\`*_\[\]<>#|~&$@]")
_NOT_PLAIN = re.compile(r'["\\]|[^\x20-\x7e]')
_SHORT = {'"': '\\"', "\\": "\\\\", "\b": "\\b", "\t": "\\t", "\n": "\\n", "\f": "\\f", "\r": "\\r"}
_FENCE = re.compile(r"`{3,}")


def one_line(text: str) -> str:
    """Return a text with every stretch of white space as one blank."""
    return " ".join(text.split())


def toml_text(text: str) -> str:
    """Return a text as a TOML string, in ASCII."""
    return f'"{_NOT_PLAIN.sub(_escaped, text)}"'


def _escaped(match: re.Match[str]) -> str:
    if match[0] in _SHORT:
        return _SHORT[match[0]]
    code = ord(match[0])
    if 0xD800 <= code <= 0xDFFF:  # half a character: TOML has no way to write it
        code = 0xFFFD
    return f"\\u{code:04x}" if code <= 0xFFFF else f"\\U{code:08x}"


def markdown(text: str) -> str:
    """Return a text as a piece of Markdown that looks like it and does nothing else."""
    return _MARKS.sub(r"\\\g<0>", one_line(text))


def fence(text: str) -> str:
    """Return backticks that nothing in the text can close."""
    return "`" * max([3, *(len(run) + 1 for run in _FENCE.findall(text))])
