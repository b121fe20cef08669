"""Mistakes of syntax: each told once, and with how it is written here where one writes as in another language.

`mistakes.txt` has what stands in an app's braces, and what is found.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.edits import applied
from plutoc.source import Source
from tests.compiler.syntax.test_mistakes import mistakes
from tests.kit.findings import findings
from tests.kit.sections import Section, compare, params


@pytest.mark.parametrize("case", params(Path(__file__).with_name("mistakes.txt")))
def test_a_mistake_is_told_once_and_with_what_to_do(case: Section, update: bool) -> None:
    """What is proposed to be put there leaves nothing to be said."""
    source = Source("app.pluto", f"pluto 1\napp demo {{\n{case.given}\n}}\n")
    found = mistakes(source.text)
    compare(case, findings(found), update)
    if found and all(each.fix for each in found):
        mended = applied(source, [each.fix for each in found if each.fix])
        assert not mistakes(mended), mended


def test_marks_of_a_merge_are_called_that() -> None:
    """Each, for each has to go."""
    text = "<<<<<<< HEAD\na = K\n=======\na = L\n>>>>>>> theirs"
    found = mistakes(f"pluto 1\napp demo {{\n{text}\n}}\n")
    assert [d.help for d in found] == [
        "two versions were merged here: keep one, and remove the lines that mark them"
    ] * 3
