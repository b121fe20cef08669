"""The reports stay what they are with any text of a source."""

from __future__ import annotations

import json as library
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plutoc.diff.phrases import amount, code
from plutoc.report.change_reports import json, markdown, text
from plutoc_runtime.domain.quantities import UNITS, Type, to_si
from tests.compiler.diff.pairs import EXAMPLES, difference, edited

PLAIN = EXAMPLES["drugs_distribution"]
TITLES = st.text(
    st.characters(codec="ascii", exclude_characters='"\\', exclude_categories=["Cc"]), max_size=40
)


@given(TITLES)
def test_a_title_is_nothing_but_a_title(title: str) -> None:
    """No link, no tag, no mention, no end of a block of code."""
    found = difference(PLAIN, edited(PLAIN, ('"Drugs distribution"', f'"{title}"')))
    report = markdown(found)
    fence = re.findall(r"^(`{3,})(?:diff)?$", report, re.MULTILINE)
    assert len(fence) == (2 if found.changes else 0)
    assert len(set(fence)) <= 1
    above = report.split("<details>\n<summary>")[0].split("<details><summary>")[0]
    without_code = re.sub(r"`[^`]*`", "", above)
    assert not set("<>[]@") & set(without_code)
    assert json(found).isascii()


def test_a_report_for_a_terminal_may_have_colours() -> None:
    """They are the only difference."""
    found = difference(PLAIN, EXAMPLES["drugs_distribution_retry"])
    coloured = text(found, colour=True)
    assert "\033[" in coloured
    assert re.sub(r"\033\[[\d;]*m", "", coloured) == text(found, colour=False)


def test_a_comment_has_room_for_what_changed_in_a_large_app() -> None:
    """GitHub takes 65,536 characters; a terminal, and a program, get everything."""
    names = [f"a_block_of_a_rather_long_name_{number}" for number in range(400)]
    chain = "".join(f"  {name} = MissionModifier(hook: look)\n" for name in names)
    way = f"create -> {' -> '.join(names)} -> allocate"
    large = edited(
        PLAIN,
        ("  create =", f"  modifier look\n  modifier note\n{chain}  create ="),
        ("create -> allocate", way),
    )
    other = edited(large, ("hook: look", "hook: note"), ("name_", "number_"))
    found = difference(large, other)
    assert len(found.changes) == 800
    assert len(markdown(found)) < 65_536
    assert text(found, colour=False).count("\n  * ") == len(found.changes)
    assert len(library.loads(json(found))["changes"]) == len(found.changes)


@pytest.mark.parametrize(
    ("number", "unit", "written"),
    [
        (5, "min", "5 min"),
        (300, "s", "5 min"),
        (90, "s", "90 s"),
        (7200, "s", "2 h"),
        (0, "s", "0 s"),
        (0.05, "g", "50 mg"),
        (0.012, "kg", "12 g"),
        (0.5, "m/s", "0.5 m/s"),
        (3, "km/h", "3 km/h"),
        (20, "%", "20 %"),
        (21, "C", "21 C"),
        (294, "K", "294 K"),
        (90, "deg", "90 deg"),
        (250, "cm", "2.5 m"),
    ],
)
def test_a_quantity_is_written_in_the_unit_that_reads_shortest(
    number: float, unit: str, written: str
) -> None:
    """With any text of the source."""
    assert amount(to_si(number, unit), UNITS[unit][0]) == written


def test_other_values_are_written_as_in_a_source() -> None:
    """And a text stands in backquotes that it cannot end."""
    assert amount(True, Type.BOOL) == "yes"
    assert amount(3, Type.INT) == "3"
    assert amount(0.25, Type.FLOAT) == "0.25"
    assert amount(None, Type.TIME) == "none"
    assert amount("a `b`", Type.TEXT) == "`\"a 'b'\"`"
    assert code("``") == "`''`"
