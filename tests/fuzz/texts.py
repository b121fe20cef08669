"""Texts that try to be more than texts, wherever they end up."""

from __future__ import annotations

HOSTILE = (
    '"""', "'''", "\\", "\\\\", '\\"', "\\N{BULLET}", "\\x41", "\\u0041", "\\n", "\\", "%s", "{0}",
    "{{ 7 * 7 }}", "{% for x in y %}", "{# #}", "{app}", "${{ secrets.TOKEN }}", "$(touch hacked)",
    "`touch hacked`", "; touch hacked", "| touch hacked", "&& touch hacked", "$HOME", "~", "!!",
    "coding: utf-7", "-*- coding: utf-7 -*-", "+AAo-import os+AAo-", "# coding=latin-1", "# fmt: on",
    "from __future__ import braces", "__import__('os').system('touch hacked')", "*/", "//", "--",
    "]]>", "<![CDATA[", "</script><script>alert(1)</script>", "<img src=x onerror=alert(1)>", "-->",
    "<!--", "&lt;", "&#60;", "[a](javascript:alert(1))", "![a](http://x/y)", "```", "~~~", "# head",
    "| a | b |", "@everyone", "#1", "::error::x", "%0A::error::x", "::set-output name=a::b",
    "x = 1\\ny = 2", "[tool.x]", 'a"\\nb = "c', "'", "\N{ZERO WIDTH SPACE}", "\N{GREEK QUESTION MARK}",
    "\N{CYRILLIC SMALL LETTER A}", "\N{FULLWIDTH QUOTATION MARK}", "\N{PILE OF POO}", "\U0010ffff",
    "\N{LATIN SMALL LETTER E}\N{COMBINING ACUTE ACCENT}", "\N{NO-BREAK SPACE}", "\ue000", "\ufffe",
    "-" * 300, "a" * 300, "(" * 200, "[" * 200, "../../etc/passwd", "/etc/passwd", "C:\\\\con", "nul",
    "style x fill:red", "click a href \\\"javascript:alert(1)\\\"", "%%{init: {}}%%", "---", "end",
    "subgraph x", "a --> b", "a -> b;", 'label=\\"x\\"', "\\l", "\\G", "\\E", "<b>x</b>", ": - ? !tag",
    "&anchor *alias", "yes", "null", "1e400", "NaN", "\N{COMBINING ENCLOSING KEYCAP}" * 30,
)  # fmt: skip
"""As they stand between two quotes of a source; some are no legal text of the language."""


def legal(text: str) -> str:
    """Return a text as a source can hold it: backslashes and quotes escaped."""
    return text.replace("\\", "\\\\").replace('"', '\\"')
