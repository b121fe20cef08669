"""The built-in action of apps whose drones follow what moves."""

from __future__ import annotations

from .actions import Action, Parameter
from .quantities import Type

FOLLOW = Action(
    name="follow",
    parameters=(
        Parameter(name="for", type=Type.TIME),
        Parameter(name="every", type=Type.TIME, default=1.0),
    ),
    repeat="safe",
    takes="for",
)
"""Stays within reach of the trip's target for so long, and takes a picture every so often."""
