"""GateFIFO passes the first branch that arrives, GateFunnel waits for all and passes the worst."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.shared.domain.status import (
    COMPLETED,
    FAILED,
    RUNNING,
    STANDBY,
    UNEXECUTED,
    Status,
)
from pluto_fleet.shared.flow.run import Run
from plutoc_blocks.gate_fifo.step import pass_first
from plutoc_blocks.gate_funnel.step import wait_for_all
from plutoc_blocks.mission_modifier.step import modify_mission
from tests.kit import apps


def arrives(after: float, status: Status, seen: list[str]) -> apps.Way:
    """A branch that arrives after so many seconds with a status."""

    async def branch(run: Run[Any], _: Status) -> Status:
        try:
            await run.core.kernel.sleep(after, key=run.key)
            seen.append(f"{status.value} at {run.core.kernel.now:g}")
        finally:
            seen.append("over")
        return status

    return branch


def through(gate: Any, *branches: tuple[float, Status]) -> tuple[Status, list[str]]:
    """Return what a gate passes on, and which branches came to their end."""
    passed: list[Status] = []
    seen: list[str] = []

    async def flow(run: Run[Any]) -> Status:
        passed.append(await gate(run, UNEXECUTED, *(arrives(*branch, seen) for branch in branches)))
        return FAILED

    apps.fly(apps.app(flow), apps.mission("m", apps.trip("A", 3.0)))
    return passed[0], seen


def test_the_first_passes_and_the_others_are_called_off() -> None:
    passed, seen = through(pass_first, (5.0, FAILED), (2.0, STANDBY), (3.0, COMPLETED))
    assert passed is STANDBY
    assert seen == ["STANDBY at 2", "over", "over", "over"]


def test_of_two_that_arrive_together_the_first_branch_passes() -> None:
    assert through(pass_first, (2.0, COMPLETED), (2.0, FAILED))[0] is COMPLETED


@pytest.mark.parametrize(
    ("statuses", "worst"),
    [
        ((COMPLETED, FAILED, STANDBY), FAILED),
        ((COMPLETED, STANDBY, RUNNING), STANDBY),
        ((RUNNING, COMPLETED), COMPLETED),
        ((UNEXECUTED, RUNNING), RUNNING),
    ],
)
def test_all_are_waited_for_and_the_worst_passes(
    statuses: tuple[Status, ...], worst: Status
) -> None:
    branches = [(float(n), status) for n, status in enumerate(statuses, 1)]
    passed, seen = through(wait_for_all, *branches)
    assert passed is worst
    assert len(seen) == 2 * len(statuses)


def test_a_fault_in_one_branch_does_not_wait_for_the_others() -> None:
    async def faulty(mission: Any, context: Any) -> None:
        await context.sleep(1)
        raise ValueError("no")

    async def beside(run: Run[Any], status: Status) -> Status:
        return await modify_mission(run, status, hook=faulty)

    async def both(run: Run[Any], status: Status) -> Status:
        return await wait_for_all(run, status, apps.watched, beside)

    outcome = apps.flown(apps.mission("m", apps.trip("A", 15.0)), watch=both)
    assert outcome.missions[0].reason == "hook faulty raised ValueError: no"
    assert apps.times(outcome, "mission.ended") == [1.0]
