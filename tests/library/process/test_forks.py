"""A hook that forks: its copy of the app is ended, and flies nothing."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any

import pytest

from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Context
from tests.kit import apps


def forked(codes: list[int]) -> None:
    """Fork, and take down what the copy ended with."""
    if pid := os.fork():
        codes.append(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))


def waiting(codes: list[int]) -> Callable[..., object]:
    async def act(drone: Any, trip: Any, context: Context) -> None:
        await context.sleep(0.001)
        forked(codes)

    return act


def _app(hook: Callable[..., object]) -> Any:
    return apps.app(
        apps.flow(),
        categories=[Category(name="scout", speed=200.0)],
        actions=[OwnAction(name="act", hook=hook)],
    )


MISSIONS = (("first", 0.6), ("second", 1.6))


def _missions() -> Sequence[apps.Mission]:
    return [
        apps.mission(name, apps.Trip(name="A", action="act", target=(x, 0.5, 0.003)), index=index)
        for index, (name, x) in enumerate(MISSIONS)
    ]


@pytest.mark.process
def test_the_copy_of_an_app_that_a_hook_forks_does_not_go_on() -> None:
    """It would fly every mission once more, or wait for ever for what its parent hears of."""
    codes: list[int] = []
    this = os.getpid()
    try:
        outcome = apps.fly(_app(waiting(codes)), *_missions())
    finally:
        if os.getpid() != this:
            os._exit(99)  # it has gone on: no test goes on here
    assert {mission.status for mission in outcome.missions} == {Status.COMPLETED}
    assert codes == [0, 0]
