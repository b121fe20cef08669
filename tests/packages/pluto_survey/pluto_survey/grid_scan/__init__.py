"""GridScan: one trip becomes a grid of trips."""

from plutoc.block import Block, Param, same
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status

from .step import spread_trips

GRID_SCAN = Block(
    name="GridScan",
    doc="""Makes of each trip a square grid of trips around its target.

    A mission of one photo becomes a survey of the ground around it.""",
    step=spread_trips,
    transitions=same(Status.UNEXECUTED),
    params=(
        Param(
            name="spacing",
            type=Type.LENGTH,
            doc="Metres between two neighbours.",
            default=1.0,
            least=0.1,
        ),
        Param(name="side", type=Type.INT, doc="Trips along a side.", default=2, least=1),
    ),
)
