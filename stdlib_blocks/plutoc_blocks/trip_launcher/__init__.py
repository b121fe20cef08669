"""TripLauncher: sends the drone on its way."""

from plutoc.block import Block, emits
from plutoc_runtime.domain.status import Status

from .step import launch_trip

TRIP_LAUNCHER = Block(
    name="TripLauncher",
    doc="""Starts the next trip with the drone that was allocated.

    The drone flies to the trip's source, if it has one, then to its target, and does the action;
    the mission goes on at once, RUNNING. Source: thesis 4.2.""",
    step=launch_trip,
    transitions={
        Status.UNEXECUTED: emits(Status.RUNNING),
        Status.STANDBY: emits(Status.RUNNING),
    },
    launches=True,
)
