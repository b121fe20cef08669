"""Tells a Crazyflie that knows only how far it has flown, by a flow deck, where it begins."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

from . import parameters

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

    from .session import Session

_HERE = "kalman.initial"
_RESET = "kalman.resetEstimation"
_ESTIMATOR, _KALMAN = "stabilizer.estimator", 2.0
_ORIGIN = 0.2
"""Metres from its own origin: that near, it has just been switched on."""


async def begin_at(session: Session, home: Point) -> None:
    """Let its map begin so that it stands at home now; one that has flown already is left alone."""
    state = session.now()
    if state.flies or hypot(state.position[0], state.position[1]) > _ORIGIN:
        return
    for axis, value in zip("XYZ", home, strict=True):
        await parameters.write(session, f"{_HERE}{axis}", value)
    await parameters.write(session, _RESET, 1.0, stays=False)
    await parameters.write(session, _RESET, 0.0)
    session.certainty.forget()


async def be_located(session: Session, position: Point) -> None:
    """Tell it where somebody else sees it; only one of its estimators listens to that."""
    if not session.located:
        session.located = True
        if parameters.element_of(session.cf, _ESTIMATOR) is not None and not session.now().flies:
            await parameters.write(session, _ESTIMATOR, _KALMAN)
    x, y, z = position
    await session.call(lambda cf: cf.extpos.send_extpos(x, y, z))
