"""What a campaign tries, in this process and in others."""

from __future__ import annotations

import sys
from types import SimpleNamespace

import pytest

from tests.kit.campaign import _by_its_name


def one(case: int) -> int:
    return case


class Flights:
    """What a campaign flies by a method."""

    def fly(self, case: int) -> int:
        return case


def test_a_scripts_function_is_found_by_its_name_and_a_method_and_an_inner_one_stay(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def inner(case: int) -> int:
        return case

    script = SimpleNamespace(__spec__=SimpleNamespace(name=__name__))
    monkeypatch.setitem(sys.modules, "__main__", script)
    fly = Flights().fly
    for function in (one, inner, Flights.fly):
        monkeypatch.setattr(function, "__module__", "__main__")
    assert _by_its_name(one) is one
    assert _by_its_name(fly) is fly
    assert _by_its_name(inner) is inner
