"""What stands in `pluto.lock` is read back, a merge's two sides too, and refused where damaged."""

from __future__ import annotations

from hashlib import sha256

import pytest

from plutoc import __version__
from plutoc.emit.lock import DamagedLock, Hooks, is_newer, lock, only_forgets, read_lock

TEXTS = {"README.md": "a", "src/a/_runtime/blocks/x.py": "b", ".gitattributes": ""}
HOOKS = Hooks(declared={"spray": "action", "app": "policy"}, former={"spray_done": "probe"})
WRITTEN = lock("a", "a.pluto", [], TEXTS, HOOKS)


@pytest.mark.parametrize("new_line", ["\n", "\r\n"])
def test_what_we_wrote_is_read(new_line: str) -> None:
    """As it was meant, also where Git has given it other line ends."""
    found = read_lock(WRITTEN.replace("\n", new_line).encode())
    assert found.app == "a"
    assert found.hooks == {"spray": "action", "app": "policy", "spray_done": "probe"}
    assert {
        path: {sha256(text.encode()).hexdigest()} for path, text in TEXTS.items()
    } == found.files
    assert found.made_by == __version__


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"README.md"', '"../README.md"'),
        ('"README.md"', '"/README.md"'),
        ('"README.md"', '"a//README.md"'),
        ('"README.md"', '"./README.md"'),
        ('plutoc = "', 'plutoc = "\x07'),
        ("\n[files]", "\n<<<<<<< ours\n[files]"),
        ("\n[files]", "\n<<<<<<< ours\n=======\n>>>>>>> theirs\nfiles\n[files]"),
        ("[versions]\n", '[versions]\nplutoc = "1"\nplutoc = "one"\n'),
        ('app = "a"', '<<<<<<< ours\napp = "a"\n=======\napp = "b"\n>>>>>>> theirs'),
        ('spray = "action"', 'spray = "reactor"'),
    ],
)
def test_what_is_damaged_is_refused(old: str, new: str) -> None:
    """No path leads out of the folder, and what was mixed by a merge is still one app's."""
    with pytest.raises(DamagedLock):
        read_lock(WRITTEN.replace(old, new, 1).encode())


OTHER = lock(
    "a",
    "a.pluto",
    [],
    {**TEXTS, "README.md": "A", "LICENSE": "c"},
    Hooks(declared={"judge": "evaluator"}, former={}),
)
BOTH = f"<<<<<<< ours\n{WRITTEN}=======\n{OTHER}>>>>>>> theirs\n"


@pytest.mark.parametrize(
    "text",
    [
        BOTH,
        BOTH.replace("=======", '||||||| 1a2b3c4\napp = "z"\nwhat was before\n======='),
        WRITTEN + OTHER,
        BOTH.replace("\n", "\r\n"),
    ],
    ids=["marks", "diff3", "lines", "Windows"],
)
def test_both_sides_of_a_merge_are_read(text: str) -> None:
    """What either of them lists is ours; what was there before both belongs to neither."""
    first, second, both = (read_lock(one.encode()) for one in (WRITTEN, OTHER, text))
    assert both.is_merged
    assert not first.is_merged
    assert both.app == "a"
    assert both.files == {
        path: first.files.get(path, frozenset()) | second.files.get(path, frozenset())
        for path in {**first.files, **second.files}
    }
    assert len(both.files["README.md"]) == 2
    assert both.hooks == {**first.hooks, **second.hooks}


def test_the_newer_of_two_sides_is_the_one_that_counts() -> None:
    """Its compiler may know what this one does not."""
    version = WRITTEN.partition('plutoc = "')[2].partition('"')[0]
    newer = BOTH.replace(f'plutoc = "{version}"', 'plutoc = "999.10"', 1)
    newest = newer.replace(f'plutoc = "{version}"', 'plutoc = "999.9"', 1)
    assert read_lock(newest.encode()).made_by == "999.10"
    assert is_newer("999.10", "999.9")


@pytest.mark.parametrize(
    ("text", "made_by"),
    [
        ('{"plutoc": "999.0", "files": []}', None),
        ('{\n  "plutoc": "999.0"\n}', "999.0"),
        ('[versions]\nplutoc = "999.0"\n[packages.crop]\nfiles = 3\n', "999.0"),
        ("[versions]\nplutoc = '999.0'\n", "999.0"),
        ('[versions]\nplutoc = "newest"\nfiles == 3\n', None),
        ("plutoc 999.0", None),
    ],
)
def test_who_wrote_it_is_made_out_of_what_cannot_be_read(text: str, made_by: str | None) -> None:
    """A later version may write its lock in another way."""
    with pytest.raises(DamagedLock) as caught:
        read_lock(text.encode())
    assert caught.value.made_by == made_by


def test_what_a_record_only_forgets_is_told_from_what_has_changed() -> None:
    """A hook that was declared once and is deleted leaves nothing out of date."""
    without = lock("a", "a.pluto", [], TEXTS, Hooks(declared=HOOKS.declared, former={}))
    more = lock("a", "a.pluto", [], TEXTS, Hooks(declared={}, former=HOOKS.former))
    assert only_forgets(WRITTEN, without)
    assert not only_forgets(without, WRITTEN)
    assert not only_forgets(WRITTEN, more.replace('"README.md"', '"READ.md"'))
    assert not only_forgets(WRITTEN, OTHER)
