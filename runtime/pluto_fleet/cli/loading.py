"""An app without its developer's own code."""

from __future__ import annotations

from typing import TYPE_CHECKING, NoReturn

if TYPE_CHECKING:
    from plutoc_runtime.app import App


def bare(name: str) -> App:
    """Return an app of which nothing but the name is known, for commands that need no more."""
    from plutoc_runtime.app import App
    from plutoc_runtime.model import Mission, Trip

    def flow(_: object) -> NoReturn:
        raise RuntimeError("nothing flies here")

    return App(
        name=name,
        title=name,
        flow=flow,
        mission=Mission,
        trip=Trip,
        fields=(),
        categories=(),
        actions={},
    )
