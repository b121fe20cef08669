"""A limit that is over while the trip's own end is on its way: what was done stays done."""

from __future__ import annotations

from functools import partial

from pluto_fleet.jobs.link import Message
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.hooks.context import Context
from pluto_fleet.shared.time.kernel import FLEET, EventKind
from tests.kit import apps
from tests.kit.living import Living, enterable, names


def delayed(living: Living, seconds: float) -> None:
    """Let reports of flights take some seconds to the brain."""
    line = living.gateway.commander
    kernel = living.kernel
    assert line is not None
    hear = line.hear

    def late(message: Message) -> None:
        arrives = partial(hear, message)
        kernel.at(kernel.now + seconds, EventKind.FLIGHT, FLEET, arrives)

    line.hear = late


def picking(*, safe_time: float, late: float) -> Living:
    mission = apps.mission("a", apps.pick("p", 3), apps.release("r", 5), safe_time=safe_time)
    living = Living(enterable(watch=apps.timed, attempts=3), mission)
    delayed(living, late)
    return living


def when_picked() -> float:
    living = picking(safe_time=100.0, late=0.0)
    living.run()
    return living.times("trip.completed", "p")[0]


def test_what_was_done_before_its_limit_was_heard_of_is_not_done_again() -> None:
    moment = when_picked()
    living = picking(safe_time=moment + 0.5, late=1.0)
    assert living.run() == ["COMPLETED"]
    assert living.done_by_drones == [("pick_item", "pills"), ("release_item", "pills")]
    assert names(living.named("trip.failed"), "trip") == []


def test_what_was_not_done_at_its_limit_fails() -> None:
    living = picking(safe_time=when_picked() - 0.5, late=0.0)
    assert living.run() == ["FAILED"]
    assert living.done_by_drones == []
    assert names(living.named("trip.launched"), "attempt") == [1, 2, 3]


def test_a_modifier_that_fails_what_was_done_fails_nothing() -> None:
    moment = when_picked()

    async def limit(mission: apps.Mission, context: Context) -> Status:
        await context.sleep(moment + 0.5)
        return Status.FAILED

    mission = apps.mission("a", apps.pick("p", 3), apps.release("r", 4))
    every = (Status.STANDBY, Status.COMPLETED, Status.FAILED)
    living = Living(enterable(watch=apps.modified(limit, *every)), mission)
    delayed(living, 1.0)
    assert living.run() == ["COMPLETED"]
