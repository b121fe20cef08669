"""A browser, and editors of apps for it to look at."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Literal, Protocol

import pytest
from playwright.sync_api import (
    Browser,
    BrowserContext,
    BrowserType,
    Page,
    Playwright,
    expect,
    sync_playwright,
)

from tests.compiler.editor.browser.serving import NAME, Editor
from tests.library.station.browser.chrome import ARGUMENTS, chromium
from tests.library.station.browser.watched import Watch
from tests.release.environments import ROOT

LAPTOP = (1366, 768)
DESKTOP = (1920, 1080)

Scheme = Literal["light", "dark"]

A_STEP = 30_000
"""Milliseconds until what a page does not do is called a failure: machines may be busy."""

expect.set_options(timeout=A_STEP)


class Edit(Protocol):
    """Starts the editor of an example, of a text, of a file, or of one that is not there yet."""

    def __call__(
        self, example: str = "", *, text: str = "", without: str = "", file: Path | None = None
    ) -> Editor: ...


class Visit(Protocol):
    """Opens an editor in a browser of its own, that shares nothing with the other ones."""

    def __call__(
        self, editor: Editor, *, size: tuple[int, int] = LAPTOP, scheme: Scheme = "light"
    ) -> Page: ...


# They end with their module: as long as the plugin's own are there, an event loop runs.


@pytest.fixture(scope="module")
def playwright() -> Iterator[Playwright]:
    """Drive browsers."""
    with sync_playwright() as driver:
        yield driver


@pytest.fixture(scope="module")
def browser_type(playwright: Playwright) -> BrowserType:
    """Drive Chromium."""
    return playwright.chromium


@pytest.fixture(scope="module")
def browser(browser_type: BrowserType) -> Iterator[Browser]:
    """Debian's Chromium."""
    browser = browser_type.launch(executable_path=chromium(), args=ARGUMENTS)
    yield browser
    browser.close()


def fresh(example: str, folder: Path) -> Path:
    """Return the file of a copy of an example, or of an app that is not there yet."""
    if example:
        shutil.copytree(ROOT / "examples" / example, folder)
    else:
        folder.mkdir()
    return folder / ("app.pluto" if example else NAME)


@pytest.fixture
def edit(tmp_path: Path) -> Iterator[Edit]:
    """Start editors; none of their processes is left behind."""
    editors: list[Editor] = []

    def edit(
        example: str = "", *, text: str = "", without: str = "", file: Path | None = None
    ) -> Editor:
        if file is None:
            file = fresh(example, tmp_path / f"app{len(editors)}")
        if text:
            file.write_text(text, encoding="utf-8")
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
def watch() -> Iterator[Watch]:
    """Fail the test for what any of its pages complains of, or asks of another machine."""
    watch = Watch()
    yield watch
    assert watch.unexpected() == []
    assert watch.abroad() == []


@pytest.fixture
def visit(browser: Browser, watch: Watch) -> Iterator[Visit]:
    """Open editors in browsers of their own, that are watched."""
    contexts: list[BrowserContext] = []

    def visit(editor: Editor, *, size: tuple[int, int] = LAPTOP, scheme: Scheme = "light") -> Page:
        context = browser.new_context(
            viewport={"width": size[0], "height": size[1]},
            color_scheme=scheme,
            reduced_motion="no-preference",
            permissions=["clipboard-read", "clipboard-write"],
        )
        context.set_default_timeout(A_STEP)
        watch.over(context)
        contexts.append(context)
        page = context.new_page()
        page.goto(editor.url)
        expect(page.get_by_role("application", name="Graph")).to_be_visible()
        expect(page.get_by_text("Saved", exact=True)).to_be_visible()
        return page

    yield visit
    for context in contexts:
        context.close()
