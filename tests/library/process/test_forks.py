"""A hook that forks: its copy of the app is ended, and flies nothing."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any

import pytest

from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Context
from tests.kit import apps, in_real_time

Fly = Callable[[Callable[..., object]], apps.SimulationResult]


def comes_back() -> None:
    """Go on in the app."""


def exits() -> None:
    raise SystemExit(0)


def raises() -> None:
    raise ValueError


def forked(child: Callable[[], None], codes: list[int]) -> None:
    """Fork, and take down what the copy ended with."""
    pid = os.fork()
    if pid:
        codes.append(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
    else:
        child()


def plain(child: Callable[[], None], codes: list[int]) -> Callable[..., object]:
    def act(drone: Any, trip: Any, context: Context) -> None:
        forked(child, codes)

    return act


def straight(child: Callable[[], None], codes: list[int]) -> Callable[..., object]:
    async def act(drone: Any, trip: Any, context: Context) -> None:
        forked(child, codes)

    return act


def waiting(child: Callable[[], None], codes: list[int]) -> Callable[..., object]:
    async def act(drone: Any, trip: Any, context: Context) -> None:
        await context.sleep(0.001)
        forked(child, codes)

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


def in_virtual_time(hook: Callable[..., object]) -> apps.SimulationResult:
    return apps.fly(_app(hook), *_missions())


def in_true_time(hook: Callable[..., object]) -> apps.SimulationResult:
    fleet = apps.fleet((0.5, 0.5, 0.0), airspace=Airspace(cruise_height=0.003))
    return in_real_time.fly(_app(hook), _missions(), fleet, lambda event: None)


@pytest.mark.process
@pytest.mark.parametrize(
    ("fly", "written", "child", "code"),
    [
        (in_virtual_time, waiting, comes_back, 0),
        *(
            pytest.param(fly, written, child, code, marks=pytest.mark.long)
            for fly in (in_virtual_time, in_true_time)
            for written in (plain, straight, waiting)
            for child, code in ((comes_back, 0), (exits, 0), (raises, 1))
        ),
    ],
)
def test_the_copy_of_an_app_that_a_hook_forks_does_not_go_on(
    fly: Fly, written: Callable[..., Any], child: Callable[[], None], code: int
) -> None:
    """It would fly every mission once more, or wait for ever for what its parent hears of."""
    codes: list[int] = []
    this = os.getpid()
    try:
        outcome = fly(written(child, codes))
    finally:
        if os.getpid() != this:
            os._exit(99)  # it has gone on: no test goes on here
    assert {mission.status for mission in outcome.missions} == {Status.COMPLETED}
    assert codes == [code, code]
