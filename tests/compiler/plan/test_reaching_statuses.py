"""Which statuses arrive where; that each switch asks for all of them, and for no others, is for `verify`."""

from __future__ import annotations

import pytest

from plutoc.plan.bodies import steps
from plutoc.plan.build import build
from plutoc.plan.model import Switch
from plutoc.plan.reaching_statuses import reaching_statuses
from plutoc_runtime.domain.status import Status
from tests.compiler.check.graphs import checked
from tests.compiler.plan.graphs import GRAPHS


@pytest.mark.parametrize("name", GRAPHS)
def test_no_more_than_what_a_switch_asks_for_comes_to_it(name: str) -> None:
    plan = build(checked(GRAPHS[name]))
    found = reaching_statuses(plan).switches
    switches = [step for step in steps(plan.body) if isinstance(step, Switch) and not step.enters]
    for switch in switches:
        came = found[id(switch)]
        assert came
        assert came <= {status for arm in switch.arms for status in arm.statuses}


def test_what_a_branch_brings_is_known_by_the_status_of_its_fork() -> None:
    """A modifier without `emits` brings what it got, a monitor any outcome."""
    plan = build(checked(GRAPHS["alfalfa"]))
    outcomes = {Status.STANDBY, Status.COMPLETED, Status.FAILED}
    brought = reaching_statuses(plan).brought.items()
    assert [(status, set(came)) for (_, status), came in brought] == [
        (Status.RUNNING, outcomes),
        (Status.RUNNING, outcomes),
    ]
