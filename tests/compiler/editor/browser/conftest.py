"""Editors of apps, and browsers that look at them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Protocol

import pytest
from playwright.sync_api import Page, expect

from tests.kit.browser import LAPTOP, Contexts, Scheme
from tests.kit.editor import Edited, Editor, fresh


class Edit(Protocol):
    """Starts the editor of an example, of a text, of a file, or of one that is not there yet."""

    def __call__(
        self,
        example: str = "",
        *,
        text: str | bytes = "",
        without: str = "",
        file: Path | None = None,
    ) -> Editor: ...


class Visit(Protocol):
    """Opens an editor in a browser of its own, that shares nothing with the other ones."""

    def __call__(
        self, editor: Edited, *, size: tuple[int, int] = LAPTOP, scheme: Scheme = "light"
    ) -> Page: ...


@pytest.fixture
def edit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Edit]:
    """Start editors; none of their threads is left behind."""
    monkeypatch.setattr("plutoc.editor.server.ENDING", ())  # signals are for processes
    editors: list[Editor] = []

    def edit(
        example: str = "", *, text: str | bytes = "", without: str = "", file: Path | None = None
    ) -> Editor:
        if file is None:
            file = fresh(example, tmp_path / f"app{len(editors)}")
        if text:
            file.write_bytes(text.encode() if isinstance(text, str) else text)
        if without:
            file.with_name(without).unlink()
        editor = Editor(file=file)
        editors.append(editor)
        editor.start()
        return editor

    yield edit
    for editor in editors:
        editor.end()


@pytest.fixture
def visit(contexts: Contexts) -> Visit:
    """Open editors in browsers of their own, that are watched."""

    def visit(editor: Edited, *, size: tuple[int, int] = LAPTOP, scheme: Scheme = "light") -> Page:
        clipboard = ["clipboard-read", "clipboard-write"]
        page = contexts.page(size=size, scheme=scheme, permissions=clipboard)
        page.goto(editor.url)
        expect(page.get_by_role("application", name="Graph")).to_be_visible()
        expect(page.get_by_text("Saved", exact=True)).to_be_visible()
        return page

    return visit
