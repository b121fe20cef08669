"""The exceptions of a navigation, one for each failure of a drone.

What counts is the attribute `failure` of an exception, and not its class: a navigation in another
package need not import these, but only give its exceptions this attribute. Their text is a reason for
a person, such as "cf1 stopped answering 1.2 s ago".
"""

from __future__ import annotations

from typing import ClassVar


class NavigationError(Exception):
    """A drone could not carry out a command, for a reason outside the software.

    Any other exception of a navigation is a bug in it: the flight fails with that reason, and the
    traceback goes to the log.
    """

    failure: ClassVar[str] = "ACTION"
    """LINK, CRASH, BATTERY, REFUSED or ACTION: the kind of failure for the app."""


class LinkLost(NavigationError):
    """It does not answer, or has sent nothing for more than a second.

    Its position is unknown; it is reconnected, and flown home if it still hovers.
    """

    failure = "LINK"


class Crashed(NavigationError):
    """It fell, hit something or lies on its back: it needs a person."""

    failure = "CRASH"


class Locked(NavigationError):
    """Its motors are locked until it is restarted."""

    failure = "CRASH"


class PositionLost(NavigationError):
    """It has lost its position: it lands, and does no action there.

    Also sent as an event, as a drone without a command must come down as well.
    """

    failure = "LINK"


class BatteryLow(NavigationError):
    """Its battery is too low for this."""

    failure = "BATTERY"


class Rejected(NavigationError):
    """It answered, and refuses: a command at the wrong moment, or an unknown name."""

    failure = "REFUSED"


class NotReady(NavigationError):
    """It is not in a state to fly; `preflight` says why."""

    failure = "REFUSED"


class OutsideArea(NavigationError):
    """The target is not permitted: refused before it moves, and never adjusted."""

    failure = "REFUSED"


class TargetTimeout(NavigationError):
    """It is healthy and answers, but has not arrived in ample time."""

    failure = "ACTION"


class ActionNotDone(NavigationError):
    """An action failed; the drone is healthy."""

    failure = "ACTION"
