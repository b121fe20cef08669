"""TripMonitor: waits for the end of the trip."""

from plutoc.block import Block, Given, Param, emits
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status

from .relief import relieve, watch_relieved
from .step import watch_trip

TRIP_MONITOR = Block(
    name="TripMonitor",
    doc="""Watches the trip in flight and ends with its outcome.

    STANDBY when it went well and trips are left, COMPLETED when it was the last, FAILED when the
    drone crashed, ran empty, was lost, or its action failed. With `relief`, a second drone takes the
    trip over before the first must go home, if one comes in time; that is no attempt. Source: thesis
    4.2; relief is ours.""",
    step=watch_trip,
    transitions={Status.RUNNING: emits(Status.STANDBY, Status.COMPLETED, Status.FAILED)},
    params=(
        Param(
            name="relief",
            type=Type.PERCENT,
            doc="What is left in the battery beyond the way home when another drone is sent for. "
            "None: the drone flies to the end.",
            least=0.0,
        ),
    ),
    given=(Given(param="relief", step=watch_relieved, limit=relieve),),
    watches=True,
)
