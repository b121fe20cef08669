"""A few random apps whose hooks write wherever they can."""

from __future__ import annotations

import pytest

from pluto_fleet.shared.domain.keeper import Keeper
from tests.hooks.__main__ import one_app


@pytest.mark.parametrize("number", range(8))
def test_nothing_stops_but_the_missions_of_such_hooks(number: int) -> None:
    assert one_app(number) == []


def test_it_is_seen_if_hooks_may_write_what_they_like(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Keeper, "written", lambda keeper, of, name, value: value)
    found = []
    for number in range(20):
        try:
            found += one_app(number)
        except Exception as error:  # noqa: BLE001 - as in the campaign
            found.append(repr(error))
    assert len(found) > 3
