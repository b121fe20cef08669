"""Which statuses arrive where, counted again in another way."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from plutoc.plan.build import build
from plutoc.plan.model import Body, Dispatch, Join, Loop, Switch
from plutoc.plan.reaching_statuses import reaching_statuses
from plutoc_runtime.domain.status import Status
from tests.compiler.check.graphs import checked
from tests.compiler.plan.graphs import GRAPHS
from tests.compiler.plan.walks import kept, through_plan


def switches(body: Body) -> Iterator[Switch]:
    for step in body:
        match step:
            case Join(branches=branches):
                for branch in branches:
                    yield from switches(branch.body)
            case Switch(arms=arms):
                yield step
                for arm in arms:
                    yield from switches(arm.body)
            case Loop(body=inner):
                yield from switches(inner)
            case Dispatch(cases=cases):
                for case in cases:
                    yield from switches(case.body)
            case _:
                pass


@pytest.mark.parametrize("name", GRAPHS)
def test_no_more_and_no_less_than_what_passes_arrives(name: str) -> None:
    """Each switch is come to, and asks for all that comes; a walk by chance meets nothing else."""
    plan = build(checked(GRAPHS[name]))
    found = reaching_statuses(plan).switches
    for switch in (switch for switch in switches(plan.body) if not switch.enters):
        came = found[id(switch)]
        assert came
        assert came <= {status for arm in switch.arms for status in arm.statuses}
    for seed in range(20):  # a status that no arm takes would be an error of the walk
        kept(lambda diary: through_plan(plan, diary), seed)


def test_what_a_branch_brings_is_known_by_the_status_of_its_fork() -> None:
    """A modifier without `emits` brings what it got, a monitor any outcome."""
    plan = build(checked(GRAPHS["alfalfa"]))
    outcomes = {Status.STANDBY, Status.COMPLETED, Status.FAILED}
    assert [
        (status, set(brought)) for (_, status), brought in reaching_statuses(plan).brought.items()
    ] == [
        (Status.RUNNING, outcomes),
        (Status.RUNNING, outcomes),
    ]
