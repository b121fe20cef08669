"""docs/tutorial/editor.md, step by step: what it has one type, press and draw, and what then comes.

`pytest tests/compiler/editor/browser/test_tutorial.py --update` takes its pictures anew.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.compiler.editor.browser.conftest import Edit, Visit
from tests.compiler.editor.browser.drawing import add_from_port, complete, lead, put_between, rename
from tests.compiler.editor.browser.hand import Hand, block, edge, port
from tests.compiler.editor.browser.scenes import COLOURS
from tests.examples.typed import Reader, Step, is_shown, steps
from tests.kit.editor import Editor
from tests.kit.pictures import kept, picture
from tests.kit.station import until
from tests.paths import ROOT

LESSON = ROOT / "docs" / "tutorial" / "editor.md"
PICTURES = LESSON.with_suffix("")
SIZE = (1366, 900)
SMALL = 130_000
"""Bytes of a picture."""


@dataclass(slots=True)
class Pupil:
    """Does what the page says, and holds the page against what comes."""

    page: Page
    editor: Editor
    update: bool
    text: str = LESSON.read_text(encoding="utf-8")
    pressed: set[str] = field(default_factory=set)
    taken: set[str] = field(default_factory=set)

    def press(self, words: str, *, what: Locator | None = None) -> None:
        """Press what the page calls so, in bold."""
        self.pressed.add(words)
        where = what or self.page.get_by_role("button", name=words, exact=True)
        where.click()

    def reads(self, found: Locator, words: str) -> None:
        """Read on the screen what the page quotes."""
        assert words in self.text.replace("`", ""), words
        expect(found).to_contain_text(words)

    def saved(self, *lines: str) -> None:
        """Wait until lines are on the disk, and the picture is at rest."""
        until(lambda: all(line in self.editor.text for line in lines), lambda: self.editor.text)
        expect(self.page.get_by_text("Saved", exact=True)).to_be_visible()

    def tidies(self) -> None:
        """Forget what was moved by hand."""
        self.press("Tidy")
        layout = self.editor.file.with_name("ward.pluto.layout")
        until(lambda: not layout.exists(), "it is forgotten")

    def runs(self, words: str, part: float) -> None:
        """Run the app, and move the scrubber."""
        self.press("Run", what=self.page.get_by_role("button", name="Run", exact=True))
        self.reads(self.page.locator(".run-result"), words)
        box = self.page.get_by_role("slider", name="Time of the run").bounding_box()
        assert box is not None
        Hand(self.page).click((box["x"] + box["width"] * part, box["y"] + box["height"] / 2))

    def shows(self, name: str) -> None:
        """Take one of the page's pictures."""
        expect(self.page.get_by_text("Saved", exact=True)).to_be_visible()
        taken = picture(self.page, COLOURS)
        assert len(taken) < SMALL, (name, len(taken))
        self.taken.add(name)
        if self.update:
            kept(PICTURES, name).write_bytes(taken)

    def blocks(self, language: str) -> list[str]:
        """Return what the page shows in a language."""
        return re.findall(rf"^```{language}\n(.*?)^```$", self.text, re.MULTILINE | re.DOTALL)


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Reader:
    """Return a shell in an empty folder, for one whom Git knows."""
    for role in ("AUTHOR", "COMMITTER"):
        monkeypatch.setenv(f"GIT_{role}_NAME", "You")
        monkeypatch.setenv(f"GIT_{role}_EMAIL", "you@example.org")
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", "/dev/null")
    monkeypatch.setenv("GIT_CONFIG_SYSTEM", "/dev/null")
    folder = tmp_path / "desk"
    folder.mkdir()
    return Reader(folder, tmp_path / "programs")


def types(desk: Reader, session: Iterator[Step], last: str) -> None:
    """Type the page's commands up to one of them; what it shows of them comes."""
    for step in session:
        code, came = desk.type(step)
        assert code == 0 and is_shown(step.shown, came), f"{step.command}: this came:\n{came}"
        if step.command.startswith(last):
            return
    raise AssertionError(f"the page does not say `{last}`")


@pytest.mark.long  # half a minute
def test_the_page_is_done_as_it_stands(
    edit: Edit, visit: Visit, desk: Reader, update: bool
) -> None:
    """What is typed, pressed (in bold), read (quoted), seen (pictures), and come to (the texts)."""
    session = steps(LESSON.read_text(encoding="utf-8"))
    types(desk, session, "git commit")
    editor = edit(file=desk.folder / "ward.pluto")
    page = visit(editor, size=SIZE)
    page.emulate_media(reduced_motion="reduce")
    pupil = Pupil(page, editor, update)
    _begins(pupil)
    _adds_delay_and_retry(pupil)
    _flies(pupil)
    types(desk, session, "git commit")
    _draws_the_timer(pupil)
    _declares(pupil)
    _writes_the_hook(pupil)
    _sees_it_at_work(pupil)
    types(desk, session, "plutoc diff")
    assert list(session) == []
    assert pupil.blocks("pluto")[-1] == editor.text
    assert set(re.findall(r"\*\*(.+?)\*\*", pupil.text)) == pupil.pressed
    assert set(re.findall(r"\(editor/([a-z-]+)\.png\)", pupil.text)) == pupil.taken
    assert {path.stem for path in PICTURES.glob("*")} == pupil.taken


def _begins(pupil: Pupil) -> None:
    pupil.press("Problems", what=pupil.page.locator("#tab-problems"))
    pupil.reads(_problem(pupil), "a failed trip ends its mission")


def _problem(pupil: Pupil) -> Locator:
    return pupil.page.locator("#panel-problems .problem-title").first


def _adds_delay_and_retry(pupil: Pupil) -> None:
    page, hand = pupil.page, Hand(pupil.page)
    put_between(page, "Clock", "create", "allocate")
    rename(page, "clock", "wait")
    pupil.saved("wait = Clock")
    lead(page, "watch", "allocate", "target", "wait")
    pupil.saved("watch -> wait when STANDBY")
    pupil.tidies()
    add_from_port(page, "watch", "FAILED", "PriorityManager", "manager")
    rename(page, "manager", "retry")
    pupil.saved("watch -> retry when FAILED")
    pupil.reads(_problem(pupil), "a mission that leaves retry STANDBY is stuck")
    pupil.press("Walk its path", what=page.locator("#panel-problems .problem-tools .button").first)
    for name in ("create", "wait", "allocate", "launch", "watch", "retry"):
        expect(block(page, name)).to_have_class(re.compile("lit"))
    expect(page.get_by_label("Name", exact=True)).to_have_value("retry")
    pupil.shows("walk")
    pupil.tidies()
    hand.drag(port(page, "retry", "STANDBY"), block(page, "allocate"))
    pupil.saved("retry -> allocate when STANDBY")
    hand.drag(port(page, "retry"), block(page, "end"))
    pupil.saved("retry -> end")
    expect(page.get_by_text("Sound", exact=True)).to_be_visible()
    assert pupil.blocks("pluto")[0] == pupil.editor.text


def _flies(pupil: Pupil) -> None:
    missions = pupil.editor.file.with_name("missions.toml")
    (delayed,) = pupil.blocks("toml")
    line = '  delay = "30 s"\n'
    assert line in delayed
    before, after = delayed.replace(line, ""), missions.read_text(encoding="utf-8")
    assert before in after
    missions.write_text(after.replace(before, delayed), encoding="utf-8")
    pupil.runs("3 of 3 missions completed in 6 min 4 s.", 0.45)
    pupil.shows("run")
    pupil.press("Compile")
    _writes_it(pupil)


def _writes_it(pupil: Pupil) -> None:
    pupil.press("Write", what=pupil.page.get_by_role("button", name=re.compile("^Write ")))
    expect(pupil.page.get_by_text("The package is written to ward.")).to_be_visible()
    pupil.page.get_by_role("button", name="Close this notice").click()


def _draws_the_timer(pupil: Pupil) -> None:
    page = pupil.page
    put_between(page, "GateFIFO", "watch", "wait")
    rename(page, "fifo", "first")
    pupil.saved("first = GateFIFO")
    pupil.tidies()
    lead(page, "watch", "retry", "source", "first")
    pupil.saved("first -> retry when FAILED")
    lead(page, "watch", "end", "source", "first")
    pupil.saved("first -> end otherwise")
    edge(page, "watch", "first").click()
    pupil.press("all that fits", what=page.get_by_role("radio", name="all that fits"))
    pupil.saved("watch -> first\n")
    add_from_port(page, "launch", "RUNNING", "MissionModifier", "mission_modifier")
    rename(page, "mission_modifier", "limit")
    pupil.saved("limit = MissionModifier")
    pupil.tidies()
    Hand(page).drag(port(page, "limit"), block(page, "first"))
    pupil.saved("limit -> first")


def _declares(pupil: Pupil) -> None:
    page = pupil.page
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    declaration = page.locator(".declarations input.mono").last
    declared = pupil.blocks("pluto")[1].strip()
    declaration.fill(declared)
    declaration.press("Enter")
    pupil.saved(declared)
    block(page, "limit").locator(".face").click()
    value = page.locator('.field[data-field="limit"] input')
    value.fill("3 min")
    value.press("Enter")
    pupil.saved("limit: 3 min")
    pupil.shows("timer")


def _writes_the_hook(pupil: Pupil) -> None:
    page = pupil.page
    pupil.press("Write its code: limit_trip")
    code = page.get_by_role("textbox", name="hooks.py: your own code")
    expect(code).to_contain_text("def limit_trip(")
    for line in ("does nothing yet", "await context.trip_ended"):  # what the stub does
        code.locator(".cm-line", has_text=line).last.click()
        page.keyboard.press("Control+Shift+K")
    code.locator(".cm-line", has_text="return mission.status").last.click()
    page.keyboard.press("Home")
    page.keyboard.press("Enter")
    page.keyboard.press("ArrowUp")
    complete(page, "if not await context.trip_", "trip_ended")
    complete(page, "(mission.curr", "current")
    page.keyboard.insert_text(", within=limit):")
    page.keyboard.press("Enter")  # goes in by itself
    page.keyboard.insert_text("return Status.FA")
    page.keyboard.type("I")
    found = page.locator(".cm-tooltip-autocomplete li[aria-selected]", has_text="FAILED")
    expect(found).to_be_visible()
    pupil.shows("hook")
    found.click()
    (wanted,) = pupil.blocks("python")
    until(lambda: wanted in hooks_of(pupil), lambda: hooks_of(pupil))


def hooks_of(pupil: Pupil) -> str:
    """Return the package's hooks.py, as it is on the disk."""
    return pupil.editor.file.with_name("ward").joinpath("src/ward/hooks.py").read_text("utf-8")


def _sees_it_at_work(pupil: Pupil) -> None:
    page = pupil.page
    pupil.runs("3 of 3 missions completed in 6 min 4 s.", 0.9)
    value = page.locator('.field[data-field="limit"] input')
    value.fill("20 s")
    value.press("Enter")
    pupil.saved("limit: 20 s")
    pupil.runs("0 of 3 missions completed in 1 min 30 s.", 0.5)
    pupil.shows("called-back")
    page.keyboard.press("Control+z")
    pupil.saved("limit: 3 min")
    pupil.press("Compile")
    expect(page.locator(".meaning li").first).to_be_visible()
    pupil.shows("compile")
    _writes_it(pupil)
