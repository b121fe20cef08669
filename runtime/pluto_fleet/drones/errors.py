"""What may go wrong with one drone: the exceptions of a navigation, one a failure.

What becomes of a flight is decided by the attribute `failure` of what was raised, not by its class:
a navigation that is a package of its own need not import these, but only to give its exceptions
this attribute. Their text is a reason for a person, such as "cf1 stopped answering 1.2 s ago".
"""

from __future__ import annotations

from typing import ClassVar


class NavigationError(Exception):
    """A drone could not do what it was told, for a reason that the world is to blame for.

    Any other exception of a navigation is a mistake in it: the flight fails, saying so, and the
    mistake goes to the log with its traceback.
    """

    failure: ClassVar[str] = "ACTION"
    """LINK, CRASH, BATTERY, REFUSED or ACTION: what this is to the app that flies."""


class LinkLost(NavigationError):
    """It does not answer, or has not told anything for more than a second.

    Where it is is unknown; it is connected to again, and flown home if it still hovers.
    """

    failure = "LINK"


class Crashed(NavigationError):
    """It fell, hit something or lies on its back: a person must look after it."""

    failure = "CRASH"


class Locked(NavigationError):
    """Its motors are locked until it is switched off and on."""

    failure = "CRASH"


class PositionLost(NavigationError):
    """It does not know any more where it is: it lands, and nothing is done there.

    Said by an event, too: a drone that is doing nothing must come down as well.
    """

    failure = "LINK"


class BatteryLow(NavigationError):
    """What is left in its battery does not do for this."""

    failure = "BATTERY"


class Rejected(NavigationError):
    """It answered, and will not do it: a command at the wrong moment, a value that it has not."""

    failure = "REFUSED"


class NotReady(NavigationError):
    """It is not in a state to fly; `preflight` says why."""

    failure = "REFUSED"


class OutsideArea(NavigationError):
    """It cannot go there: refused before it moves, and never brought to the nearest place."""

    failure = "REFUSED"


class TargetTimeout(NavigationError):
    """It is well and answers, but has not arrived in a time that is ample."""

    failure = "ACTION"


class ActionNotDone(NavigationError):
    """An action did not succeed; the drone is well."""

    failure = "ACTION"
