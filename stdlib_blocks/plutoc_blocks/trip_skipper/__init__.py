"""TripSkipper: a failed trip is left out."""

from plutoc.block import Block, emits
from plutoc_runtime.domain.status import Status

from .step import skip_trip

TRIP_SKIPPER = Block(
    name="TripSkipper",
    doc="""Leaves a failed trip out.

    The trip is SKIPPED, and the mission goes on with its next one, STANDBY; if none is left, it is
    COMPLETED. Ours.""",
    step=skip_trip,
    transitions={Status.FAILED: emits(Status.STANDBY, Status.COMPLETED)},
    skips=True,
)
