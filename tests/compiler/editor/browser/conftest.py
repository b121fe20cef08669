"""Editors of apps, and browsers that look at them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.kit.browser import LAPTOP, Contexts
from tests.kit.editor import Edited, Editor, fresh


class Edit:
    """Starts the editor of an example, of a text, of a file, or of one that is not there yet."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.editors: list[Editor] = []

    def __call__(
        self, example: str = "", *, text: str | bytes = "", file: Path | None = None
    ) -> Editor:
        if file is None:
            file = fresh(example, self._folder / f"app{len(self.editors)}")
        if text:
            file.write_bytes(text.encode() if isinstance(text, str) else text)
        editor = Editor(file=file)
        self.editors.append(editor)
        editor.start()
        return editor


@pytest.fixture
def edit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Edit]:
    """Start editors; none of their threads is left behind."""
    monkeypatch.setattr("plutoc.editor.server.ENDING", ())  # signals are for processes
    edit = Edit(tmp_path)
    yield edit
    for editor in edit.editors:
        editor.end()


class Visit:
    """Opens an editor in a browser of its own, that shares nothing with the other ones."""

    def __init__(self, contexts: Contexts) -> None:
        self._contexts = contexts

    def __call__(self, editor: Edited, *, size: tuple[int, int] = LAPTOP) -> Page:
        clipboard = ["clipboard-read", "clipboard-write"]
        page = self._contexts.page(size=size, permissions=clipboard)
        page.goto(editor.url)
        expect(page.get_by_role("application", name="Graph")).to_be_visible()
        expect(page.get_by_text("Saved", exact=True)).to_be_visible()
        return page


@pytest.fixture
def visit(contexts: Contexts) -> Visit:
    """Open editors in browsers."""
    return Visit(contexts)
