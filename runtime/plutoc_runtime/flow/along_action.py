"""An action of the app's own on the way: its hook runs from the launch to the last leg's end."""

from __future__ import annotations

from dataclasses import dataclass

from ..domain.actions import Action


@dataclass(frozen=True, slots=True, kw_only=True)
class AlongAction(Action):
    """An action of the app's own, done while the drone flies."""

    returns: type[object] | None = None
    """The type of what its hook gives; None: the app does not say."""
