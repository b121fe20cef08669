"""How hooks are called: alone the brain knows errors, in an app's process also whose an interrupt is."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from pluto_fleet.process.signal_guard import guard_hooks, interrupted_by_a_person
from pluto_fleet.shared.domain import guard
from pluto_fleet.shared.domain.errors import Cancelled


@pytest.fixture(autouse=True)
def _alone() -> Iterator[None]:
    """Call hooks as a package does that has no library beside it, then as the other tests do."""
    guard.put_guard(guard.Guard())
    yield
    guard_hooks()


def raising(error: BaseException) -> Callable[[], Any]:
    def hook() -> None:
        raise error

    return hook


@pytest.mark.parametrize("error", [Cancelled(), GeneratorExit()])
def test_a_hook_ends_nothing_but_itself(error: BaseException) -> None:
    with pytest.raises(RuntimeError, match=f"it may not raise {type(error).__name__}"):
        guard.guarded(raising(error))


@pytest.mark.parametrize("error", [SystemExit(1), ValueError("wrong"), StopIteration(2)])
def test_other_errors_come_through_as_they_are(error: BaseException) -> None:
    with pytest.raises(type(error)) as caught:
        guard.guarded(raising(error))
    assert caught.value is error


def test_alone_an_interrupt_is_taken_for_a_persons() -> None:
    with pytest.raises(KeyboardInterrupt):
        guard.guarded(raising(KeyboardInterrupt()))
    with interrupted_by_a_person(), pytest.raises(KeyboardInterrupt):
        guard.guarded(raising(KeyboardInterrupt()))


def test_in_an_apps_process_it_can_be_told() -> None:
    guard_hooks()
    fault = pytest.raises(RuntimeError, match="it may not raise KeyboardInterrupt")
    with interrupted_by_a_person(), fault:
        guard.guarded(raising(KeyboardInterrupt()))
