"""One history over text, hooks and layout: back to the very same bytes, whoever changed what."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plutoc.editor.changes import Edit
from plutoc.editor.history import Change, File, History, Stale, TooLarge
from plutoc.editor.wire import Wire
from plutoc.source import LARGEST

from .test_wire import TEXTS, edits_of, in_browser


def state(history: History) -> tuple[str, str | None, dict[str, tuple[int, int]]]:
    return history.app, history.hooks, dict(history.positions)


@settings(max_examples=60)
@given(TEXTS, st.none() | TEXTS, st.data())
def test_undo_leads_back_to_the_same_bytes_and_redo_forth_again(
    app: str, hooks: str | None, data: st.DataObject
) -> None:
    """Two clients type, move, and the disk changes it; each also knows what the others did."""
    history = History(app=app, hooks=hooks)
    shown = {File.APP: Wire(app).shown, File.HOOKS: Wire(hooks or "").shown}
    first = state(history)
    now = 0.0
    for _ in range(data.draw(st.integers(1, 12))):
        by, file = data.draw(st.sampled_from([1, 2])), data.draw(
            st.sampled_from([File.APP, File.HOOKS])
        )
        now += data.draw(st.sampled_from([0.1, 0.5, 2.0]))
        kind = data.draw(st.sampled_from(["type", "type", "type", "place", "disk", "undo", "redo"]))
        if kind == "type":
            typed = edits_of(data, Wire(history.text(file)))
            try:
                one = history.type(file, typed, history.version, by, now)
            except Stale:
                continue
            made = [one] if one else []
        elif kind == "place":
            at = data.draw(st.none() | st.tuples(st.integers(-9, 9), st.integers(-9, 9)))
            made = history.change([history.placed({"a": at})], by)
        elif kind == "disk":
            edit = Edit(0, len(history.text(file)), data.draw(TEXTS))
            made = history.change([history.edited(file, (edit,))], 0)
        else:
            made = history.undo(by) if kind == "undo" else history.redo(by)
        for each in made:
            if each.file in shown:
                shown[each.file] = in_browser(shown[each.file], each.sent)
        assert shown[File.APP] == Wire(history.app).shown
        assert shown[File.HOOKS] == Wire(history.hooks or "").shown
    while history.redo(1):
        pass
    last = state(history)
    for _ in range(2):
        while history.undo(1):
            pass
        assert state(history) == first
        while history.redo(2):
            pass
        assert state(history) == last


def typed(
    history: History, start: int, text: str, version: int, *, by: int = 1, now: float = 0.0
) -> None:
    history.type(File.APP, (Edit(start, start, text),), version, by, now)


def renamed(history: History) -> None:
    """Change text, hooks and layout in one step."""
    made: list[Change] = [
        history.edited(File.APP, (Edit(0, 1, "N"),)),
        history.edited(File.HOOKS, (Edit(0, 0, "def n"),)),
        history.placed({"n": (1, 2)}),
    ]
    history.change(made, 1)


def written(history: History) -> None:
    history.change([history.edited(File.APP, (Edit(1, 3, ""),))], 0)


def moved(history: History) -> None:
    history.change([history.placed({"n": (3, 4), "m": (5, 6)})], 2)


def typed_on(history: History) -> None:
    """Type two letters one after the other, which is one step."""
    for letter in "yx":
        typed(history, 1, letter, history.version, now=9.0)


STEPS = (renamed, typed_on, moved, written)


def test_redo_gives_back_step_by_step_what_undo_took_the_last_one_first() -> None:
    history = History(app="one\n")
    states = [state(history)]
    for step in STEPS:
        step(history)
        states.append(state(history))
    assert len({str(one) for one in states}) == len(states)
    for left in reversed(range(len(STEPS))):
        assert {one.by for one in history.undo(7)} == {7}
        assert state(history) == states[left]
        assert history.depth == {"undo": left, "redo": len(STEPS) - left}
    assert history.undo(7) == []
    for done in range(1, len(STEPS) + 1):
        assert {one.by for one in history.redo(8)} == {8}
        assert state(history) == states[done]
        assert history.depth == {"undo": done, "redo": len(STEPS) - done}
    assert history.redo(8) == []
    assert state(history) == states[-1]


@pytest.mark.parametrize("step", STEPS)
def test_what_was_undone_is_gone_once_anything_else_is_done(
    step: Callable[[History], None],
) -> None:
    """Redo would put old words into a text that they were never part of."""
    history = History(app="one\n")
    typed(history, 3, "a", 0)
    typed(history, 0, "b", 1, now=5.0)
    history.undo(1)
    history.undo(1)
    step(history)
    after, depth = state(history), dict(history.depth)
    assert depth == {"undo": 1, "redo": 0}
    assert history.redo(1) == []
    assert (state(history), dict(history.depth)) == (after, depth)


def test_what_changes_nothing_leaves_what_was_undone() -> None:
    history = History(app="one\n")
    typed(history, 3, "a", 0)
    history.undo(1)
    history.change([history.edited(File.APP, (Edit(0, 1, "o"),))], 1)
    history.redo(1)
    assert history.app == "onea\n"


def test_typing_on_after_a_redo_is_a_step_of_its_own() -> None:
    """However quickly: it is not what was undone that goes on."""
    history = History(app="one\n")
    typed(history, 3, "a", 0)
    history.undo(1)
    history.redo(1)
    typed(history, 4, "b", history.version)
    history.undo(1)
    assert history.app == "onea\n"


def test_typing_is_undone_by_pauses_and_by_places() -> None:
    history = History(app="one two\n")
    typed(history, 3, "a", 0)
    typed(history, 4, "b", 1, now=0.5)
    typed(history, 5, "c", 2, now=2.0)  # after a pause
    typed(history, 0, "d", 3, now=2.1)  # elsewhere
    assert history.app == "doneabc two\n"
    texts = []
    while history.undo(1):
        texts.append(history.app)
    assert texts == ["oneabc two\n", "oneab two\n", "one two\n"]


def test_two_who_type_at_once_both_get_their_words_in() -> None:
    history = History(app="one two\n")
    typed(history, 3, "A🚁", 0, by=1)
    typed(history, 7, "B", 0, by=2)
    assert history.app == "oneA🚁 twoB\n"
    history.type(File.APP, (Edit(4, 7, "2"),), 0, 3, 0.0)  # the word that another one typed behind
    assert history.app == "oneA🚁 2B\n"


@pytest.mark.parametrize("edit", [Edit(1, 3, ""), Edit(2, 2, "x")])
def test_what_is_typed_into_what_is_gone_is_refused(edit: Edit) -> None:
    history = History(app="one two\n")
    history.type(File.APP, (Edit(0, 4, ""),), 0, 1, 0.0)
    with pytest.raises(Stale):
        history.type(File.APP, (edit,), 0, 2, 0.0)
    assert history.app == "two\n"


@pytest.mark.parametrize("version", [-1, 5])
def test_a_version_that_there_is_not_is_refused(version: int) -> None:
    with pytest.raises(Stale):
        typed(History(app="one\n"), 0, "x", version)


def test_a_client_that_does_not_wait_for_its_answer_is_refused() -> None:
    """Its places would mean another text."""
    history = History(app="one\n")
    typed(history, 0, "a", 0)
    with pytest.raises(Stale):
        typed(history, 1, "b", 0)


def test_a_file_that_came_about_here_is_gone_again() -> None:
    history = History(app="")
    history.change([history.edited(File.HOOKS, (Edit(0, 0, ""),))], 1)
    assert history.hooks == ""
    history.undo(1)
    assert history.hooks is None


def test_no_text_becomes_larger_than_the_compiler_reads() -> None:
    history = History(app="x" * (LARGEST - 1))
    with pytest.raises(TooLarge):
        typed(history, 0, "🚁", 0)
    assert history.version == 0
