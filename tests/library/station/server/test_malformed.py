"""JSON from strangers, at the address of a command."""

from __future__ import annotations

import json
from contextlib import suppress

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.web.handlers import OPERATIONS

PLAN = OPERATIONS["replace_plan"]
MUCH = 1_000_000


def missions(text: str) -> object:
    """Return the missions of a plan that says this of them."""
    return PLAN.sent(f'{{"revision": 1, "missions": {text}}}'.encode())["missions"]


@settings(max_examples=100, derandomize=True, deadline=None)
@given(text=st.text(alphabet='{}[]",:\\u0d8019.eE-+ aN', max_size=40))
def test_what_is_not_is_refused_and_nothing_else(text: str) -> None:
    try:
        data = missions(f"[{text}]")
    except BadInput:
        return
    assert json.loads(f"[{text}]") == data
    json.dumps(data, allow_nan=False, ensure_ascii=False).encode()


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(max_size=3),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner),
    max_leaves=10,
)


@settings(max_examples=20, derandomize=True, deadline=None)
@given(data=st.data())
def test_whatever_is_sent_to_whichever_address_is_taken_or_refused(data: st.DataObject) -> None:
    for one in OPERATIONS.values():
        fields = {name: data.draw(JSON) for name in one.body or () if data.draw(st.booleans())}
        with suppress(BadInput):
            one.sent(json.dumps(fields).encode())
        with suppress(BadInput):
            one.asked({name: data.draw(st.text(max_size=3)) for name in one.query})


@pytest.mark.parametrize(
    "text",
    [
        '"' + '\\"' * (MUCH // 2),
        '"' * MUCH,
        "[" * MUCH,
        '{"a":' * (MUCH // 5),
        "1" * MUCH,
        "1." + "0" * MUCH + "e",
        '"' + "\\ud800" * (MUCH // 6) + '"',
        "[" * 9 + "]" * 9,
        str(2**53 + 1),
        "1e999",
    ],
    ids=range(10),
)
def test_much_nonsense_is_found_out_as_fast_as_it_is_read(text: str) -> None:
    with pytest.raises(BadInput):
        missions(text)
