"""Names are of a few plain characters: nothing else ever becomes a name in what is generated."""

from __future__ import annotations

import pytest

from plutoc.compile import analyse
from plutoc.diagnostic import Rejected
from plutoc.source import Source
from tests.hostile.apps import app

ODD = [
    "../crop", "..", "/crop", "a/b", "a\\b", "C:crop", "~", ".crop", "crop.", "a b", "a-b", "a;b",
    "a$b", "`a`", "$(a)", "a'b", "a%b", "{{a}}", "a\0b", "a\u202eb", "a\u200bb", "\u0441rop", "ﬁeld",
    "crop\u0301", "ｃrop", "１a", "a\u00adb", "-o", "--force", "con", "nul", "COM1", "os", "json",
    "tests", "src", "plutoc", "pluto", "__init__", "_a", "a" * 64, "", "class", "Crop", "self",
]  # fmt: skip
PLACES = [
    ("app crop", "app {}"),
    ("action wave", "action {}"),
    ("evaluator find\n", "evaluator {}\n"),
    ("sign: text", "{}: text"),
    ("launch =", "{} ="),
]


@pytest.mark.parametrize(("old", "new"), PLACES, ids=lambda text: text.strip())
def test_an_odd_name_is_refused_with_a_place(old: str, new: str) -> None:
    """Or it is an ordinary name in that place, such as `os` for a block."""
    for name in ODD:
        source = Source("crop.pluto", app("plain").replace(old, new.format(name)))
        try:
            analyse(source)
        except Rejected as rejected:
            first = rejected.diagnostics[0]
            assert 0 <= first.span.start <= first.span.end <= len(source.text) + 1, name
            continue
        assert name.isidentifier() and name.isascii() and len(name) <= 63
        assert not (old.startswith("app") and name in ("os", "json", "tests", "src", "con", "nul"))


def test_letters_that_look_alike_are_told_apart() -> None:
    """A Cyrillic letter in a block's name cannot make a second block that looks like the first."""
    text = app("plain").replace("launch -> watch", "l\u0430unch -> watch")
    with pytest.raises(Rejected) as caught:
        analyse(Source("crop.pluto", text))
    assert {one.code for one in caught.value.diagnostics} <= {"P1001", "P1032"}
