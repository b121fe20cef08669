"""What is typed into a large app is read as its touched statements alone, and is found all the same."""

from __future__ import annotations

import pytest

from large_apps import SHAPES, app
from plutoc.diagnostic import Diagnostic
from plutoc.lsp.apps import Apps
from plutoc.service.document import Document
from plutoc.source import Source
from plutoc.syntax.parse import read
from plutoc.syntax.tree import File

TYPED = "  again = Clock\n  again -> end when FA\n"
URI = "untitled:large.pluto"


@pytest.mark.parametrize("shape", SHAPES)
def test_each_keystroke_finds_what_the_whole_text_would(
    shape: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = app(shape, 100)
    half = text[: len(text) // 2].rfind("\n") + 1
    apps = Apps()
    apps.open(URI, text, 0, "pluto")
    first = apps.app(URI)
    assert first is not None and first.findings == ()
    lengths: list[int] = []

    def counted(source: Source) -> tuple[File, tuple[Diagnostic, ...]]:
        lengths.append(len(source.text))
        return read(source)

    for typed in range(1, len(TYPED) + 1, 3):
        now = text[:half] + TYPED[:typed] + text[half:]
        apps.open(URI, now, typed, "pluto")
        found = apps.app(URI)
        assert found is not None
        with monkeypatch.context() as patched:
            patched.setattr("plutoc.syntax.again.read", counted)
            findings = found.findings
        assert findings == Document(path=URI, text=now).diagnostics
    assert lengths and max(lengths) < len(text) / 4
