"""DroneAllocator: gives a mission the drone for its next trip."""

from plutoc.block import Block, Choice, HookKind, Param, emits, same
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status
from plutoc_runtime.fleet.batch_optimal import batch_optimal
from plutoc_runtime.fleet.earliest_deadline import earliest_deadline
from plutoc_runtime.fleet.least_makespan import least_makespan
from plutoc_runtime.fleet.own_policy import own_policy
from plutoc_runtime.fleet.policies import first, least_used, nearest

from .step import allocate_drone

DRONE_ALLOCATOR = Block(
    name="DroneAllocator",
    doc="""Waits for a drone that can do the next trip, and takes it.

    The fleet has one queue: the head trip's priority counts first, then arrival. A drone is
    eligible if its category can do the action and carry the item, and if its battery covers the
    way there, the action, the way home and the reserve. A failed mission is let in only by an
    edge whose guard says so: its head trip is put back first. Source: thesis 4.2.""",
    step=allocate_drone,
    transitions=same(Status.UNEXECUTED, Status.STANDBY),
    guarded={Status.FAILED: emits(Status.STANDBY)},
    params=(
        Choice(
            name="policy",
            options={
                "nearest": nearest,
                "first": first,
                "least_used": least_used,
                "batch_optimal": batch_optimal,
                "least_makespan": least_makespan,
                "earliest_deadline": earliest_deadline,
            },
            default="least_makespan",
            doc="How one of several drones is chosen. The first three choose for trip after trip. The "
            "others look at all that wait: `batch_optimal` for the least way in total, "
            "`least_makespan` plans ahead, so that the last trip ends soonest, and "
            "`earliest_deadline` prefers missions that are due.",
            hook=HookKind.POLICY,
            adapt=own_policy,
        ),
        Param(
            name="allocate_within",
            type=Type.TIME,
            doc="The mission fails if it has waited this long for a drone. None: no limit.",
            least=0.0,
        ),
        Param(
            name="fail_late",
            type=Type.BOOL,
            default=False,
            doc="Whether a mission fails that is late and has no drone: its deadline has passed.",
        ),
    ),
    uses=("priority",),
    named=True,
    allocates=True,
)
