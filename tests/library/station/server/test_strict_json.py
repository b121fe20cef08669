"""JSON from strangers."""

from __future__ import annotations

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.station.commands import Malformed
from pluto_fleet.station.web.strict_json import DEEPEST, parsed


@settings(max_examples=40, derandomize=True, deadline=None)
@given(text=st.text(alphabet='{}[]",:\\u0d8019.eE-+ aN', max_size=40))
def test_what_is_not_is_malformed_and_nothing_else(text: str) -> None:
    try:
        data = parsed(text)
    except Malformed:
        return
    assert json.loads(text) == data
    json.dumps(data, allow_nan=False, ensure_ascii=False).encode()


def test_it_may_be_so_deep_and_no_deeper() -> None:
    assert parsed("[" * DEEPEST + "]" * DEEPEST)
    with pytest.raises(Malformed, match="nested deeper"):
        parsed("[" * (DEEPEST + 1) + "]" * (DEEPEST + 1))
    assert parsed('["' + "[" * 1000 + '\\"{"]') == ["[" * 1000 + '"{']
    assert parsed("[" + "[]," * 1000 + "[]]") == [[]] * 1001


MUCH = 1_000_000


@pytest.mark.parametrize(
    "text",
    [
        '"' + '\\"' * (MUCH // 2),
        '"' * MUCH,
        "[" * MUCH,
        '{"a":' * (MUCH // 5),
        "1." + "0" * MUCH + "e",
        '"' + "\\ud800" * (MUCH // 6) + '"',
    ],
    ids=range(6),
)
def test_much_nonsense_is_found_out_as_fast_as_it_is_read(text: str) -> None:
    with pytest.raises(Malformed):
        parsed(text)
