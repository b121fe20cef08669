"""The actions of an app's own that were done in a flight.

They run in the app, so no drone measures them: a journal says when each began, and when its trip was completed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Acted:
    """One action of the app's own that was done."""

    action: str
    seconds: float
    parameters: Mapping[str, Any]
    """Those of its trip."""


class Acting:
    """What becomes of the own actions of one journal, event by event."""

    def __init__(self, own: Mapping[str, object]) -> None:
        self.acted: list[Acted] = []
        """What was done, in order."""
        self._own = own
        self._begun: dict[str, float] = {}
        """When the action of each mission began last."""

    def hear(self, event: Mapping[str, Any]) -> None:
        """Take an event; one of a trip that was completed has this trip as `did`."""
        match event["event"]:
            case "action.begun":
                self._begun[event["mission"]] = event["t"]
            case "trip.completed":
                began = self._begun.pop(event["mission"], None)
                trip = event["did"]
                # when it was done is unknown where that was only found out afterwards
                if began is None or event.get("found_out") or trip["action"] not in self._own:
                    return
                self.acted.append(
                    Acted(
                        action=trip["action"],
                        seconds=event["t"] - began,
                        parameters=trip.get("parameters", {}),
                    )
                )
