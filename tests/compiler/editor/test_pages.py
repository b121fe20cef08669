"""The editor's pages as files: what the compiler's words say, small modules, and nobody else's address."""

from __future__ import annotations

import re

from plutoc.highlight.rules import RULES, Kind
from tests.paths import ROOT

PAGES = ROOT / "plutoc" / "editor" / "pages"
OWN = sorted(
    path
    for path in PAGES.rglob("*")
    if path.suffix in (".js", ".css", ".html") and "codemirror" not in path.parts
)


def test_pages_make_no_elements_of_texts_and_ask_no_other_machine() -> None:
    for path in OWN:
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"https?://(?!www\.w3\.org/)", text), path
        assert "innerHTML" not in text, path


def test_the_text_has_the_compilers_words() -> None:
    """What stands out in the text pane is what stands out in Pygments and Visual Studio Code."""
    mode = (PAGES / "text" / "pluto_mode.js").read_text(encoding="utf-8")
    groups = [set(found.split("|")) for found in re.findall(r"\(\?:([A-Za-z_|]+)\)", mode)]
    told = (Kind.WORD, Kind.CONSTANT, Kind.STATUS, Kind.TYPE, Kind.TERMINAL)
    for rule in RULES:
        if rule.kind in told:
            (words,) = re.findall(r"\\b\(\?:([^)]+)\)", rule.pattern)
            assert set(words.split("|")) in groups, rule
