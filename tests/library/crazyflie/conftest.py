"""Async tests with a `folder` are flights in real time: all of them are flown at once, by the first."""

from __future__ import annotations

import inspect
from pathlib import Path

import pytest

from tests.library.crazyflie.hangar import Outcomes, all_at_once


@pytest.fixture(scope="session")
def outcomes(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Outcomes:
    """Fly all flights that were collected, each with a drone and a folder of its own."""
    flights = [test.function for test in map(flight, request.session.items) if test is not None]
    return all_at_once(flights, lambda: tmp_path_factory.mktemp("flight"))


@pytest.fixture
def folder(outcomes: Outcomes) -> None:
    """Ask for the flights: each has had its folder there."""


def flight(item: pytest.Item) -> pytest.Function | None:
    """Return the test if it is one of these flights."""
    if not isinstance(item, pytest.Function) or "folder" not in item.fixturenames:
        return None
    here = item.path.parent == Path(__file__).parent
    return item if here and inspect.iscoroutinefunction(item.function) else None


def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """Say what came of a flight that was flown with all others."""
    if flight(pyfuncitem) is None:
        return None
    outcomes: Outcomes = pyfuncitem.funcargs["outcomes"]  # type: ignore[assignment]
    outcome = outcomes[pyfuncitem.function]
    if outcome is not None:
        raise outcome
    return True
