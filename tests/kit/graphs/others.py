"""Blocks of another author: some wait as ours do, some only look as if they did."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from plutoc.block import ANY_SAME, Block, Param, emits
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status
from plutoc_runtime.flow.flight import Limit
from plutoc_runtime.flow.run import watch
from plutoc_runtime.time.kernel import EventKind

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Trip
    from plutoc_runtime.flow.run import Run

PACKAGE = "others"
OUTCOMES = {Status.RUNNING: emits(Status.STANDBY, Status.COMPLETED, Status.FAILED)}


async def look(run: Run[Any], status: Status) -> Status:
    """Wait for the trip's end."""
    return await watch(run)


async def look_and_tell(run: Run[Any], status: Status, *, block: str) -> Status:
    """Wait for the trip's end, and tell who did."""
    ended = await watch(run)
    run.core.log(f"{block} saw {ended.value}", run.mission.name)
    return ended


async def hold_to_the_deadline(
    run: Run[Any], status: Status, *, within: float | None = None, deadline: float | None
) -> Status:
    """Wait for the trip's end, and fail the trip at the deadline."""
    return await watch(run, deadline_limit(run, within=within, deadline=deadline))


def deadline_limit(
    run: Run[Any], *, within: float | None = None, deadline: float | None
) -> Limit | None:
    """Return the limit of the trip in flight, if it has any."""
    flight, span = run.state.flight, within if deadline is None else deadline
    return None if flight is None or not span else Limit(flight.launched_at, span, _late)


def _late(trip: Trip, span: float) -> str:
    return f"trip {trip.name} missed its deadline of {span:g} s"


async def lose_patience(run: Run[Any], status: Status, *, within: float) -> Status:
    """Do the same without saying so in the declaration."""
    return await watch(run, deadline_limit(run, within=within, deadline=None))


async def nap(run: Run[Any], status: Status, *, seconds: float = 1.0, deep: bool = False) -> Status:
    """Sleep for a while."""
    await run.core.kernel.sleep(seconds * (2 if deep else 1), EventKind.CLOCK, run.key)
    run.core.log(f"napped in {status.value}", run.mission.name)
    return status


def tell(run: Run[Any], status: Status) -> Status:
    """Tell the status, and take no time."""
    run.core.log(f"passes in {status.value}", run.mission.name)
    return status


EYE = Block(name="Eye", doc="Watches.", step=look, transitions=OUTCOMES, watches=True)
WITNESS = Block(
    name="Witness",
    doc="Watches, and tells.",
    step=look_and_tell,
    transitions=OUTCOMES,
    watches=True,
    named=True,
)
DEADLINE = Block(
    name="Deadline",
    doc="Fails a trip that is late.",
    step=hold_to_the_deadline,
    transitions=OUTCOMES,
    params=(Param(name="within", type=Type.TIME, doc="How late it may be.", least=0.0),),
    needs=(
        Field(
            name="deadline",
            on=Entity.MISSION,
            type=FieldType.TIME,
            label="Deadline",
            doc="How late each trip may be.",
        ),
    ),
    watches=True,
    limits=True,
    limit=deadline_limit,
)
PATIENCE = Block(
    name="Patience",
    doc="Fails a trip that takes long, and hides how.",
    step=lose_patience,
    transitions=OUTCOMES,
    params=(Param(name="within", type=Type.TIME, doc="How long.", default=9.0, least=0.0),),
    watches=True,
    limits=True,
)
NAP = Block(
    name="Nap",
    doc="Waits.",
    step=nap,
    transitions=ANY_SAME,
    params=(
        Param(name="seconds", type=Type.TIME, doc="How long.", default=1.0, least=0.0),
        Param(name="deep", type=Type.BOOL, doc="Twice as long.", default=False),
    ),
)
TELL = Block(name="Tell", doc="Tells the status.", step=tell, transitions=ANY_SAME)

BLOCKS: Mapping[str, Block] = {
    block.name: block for block in (EYE, WITNESS, DEADLINE, PATIENCE, NAP, TELL)
}
