"""What clients send: the bodies of commands and of edits of the plan, and what is answered.

The first line of each docstring says what the command does, in the description of the interface.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, NotRequired, TypedDict

from .wire import Scalar
from .wire_app import PlanMission, PlanTrip


class Said(TypedDict):
    """What was done, or why it was not: a sentence for people."""

    said: str


class Command(TypedDict):
    """A command; sent again with the same id it is answered as before, and done once."""

    id: str


class Start(Command):
    """Fly missions of the plan."""

    revision: NotRequired[int | None]
    """The revision that was looked at: another is refused; null: any."""
    missions: NotRequired[list[str] | None]
    """The keys of missions; null: all that have not been completed, or all again."""
    only_failed: NotRequired[bool | None]
    """Whether trips that were done are left out of missions that failed."""


class Stop(Command):
    """Bring all drones down at once."""

    how: Literal["rtl", "land"]
    """`rtl`: all fly home first; `land`: where they are."""


class Resume(Command):
    """Go on with a flight that was stopped or interrupted."""


class Discard(Command):
    """Put a flight away that was stopped or interrupted; its journal stays."""


class Pause(Command):
    """Call a mission's drone home until it goes on."""

    mission: NotRequired[str | None]
    """Its name; null: all missions."""


class GoOn(Command):
    """Let a paused mission go on."""

    mission: NotRequired[str | None]


class Skip(Command):
    """Leave a trip out."""

    mission: str
    trip: NotRequired[str | None]
    """Its name; null: the next one."""


class Cancel(Command):
    """End a mission for good."""

    mission: NotRequired[str | None]
    """Its name; null: all missions."""


class Decide(Command):
    """Answer the question of a mission."""

    mission: str
    answer: str


class Prioritise(Command):
    """Change the priority of a trip."""

    mission: str
    trip: str
    priority: int


class ChangeTrips(Command):
    """Change what has not flown of a mission that is under way."""

    mission: str
    trips: list[PlanTrip]
    """All that is to be flown from now on, but for the trip that flies now."""
    replaces: NotRequired[list[str] | None]
    """The names of the trips that were seen to wait: others are refused; null: any."""


class Retire(Command):
    """Give a drone to no mission any more, once its trip is done."""

    drone: str


class BringBack(Command):
    """Say that a lost or retired drone can fly again."""

    drone: str


class Join(Command):
    """Let a drone join the flight that is under way, as an entry of a fleet file says it."""

    drone: str
    """Its id."""
    category: NotRequired[str | None]
    home: NotRequired[list[float] | None]
    uri: NotRequired[str | None]
    navigation: NotRequired[str | None]
    options: NotRequired[dict[str, Scalar] | None]
    parameters: NotRequired[dict[str, Scalar] | None]


class Mishap(Command):
    """Let something go wrong with a simulated drone, to rehearse it."""

    drone: str
    kind: Literal["lost", "crash", "battery", "uncertain"]


class CutMotors(Command):
    """Switch a drone's motors off at once: if it flies, it falls."""

    drone: str


class Acknowledge(Command):
    """Say that a person knows of an alert."""

    alert: str
    """Its id."""


COMMANDS: Mapping[str, type[Command]] = {
    "start": Start,
    "stop": Stop,
    "resume": Resume,
    "discard": Discard,
    "pause": Pause,
    "go-on": GoOn,
    "skip": Skip,
    "cancel": Cancel,
    "decide": Decide,
    "change-trips": ChangeTrips,
    "prioritise": Prioritise,
    "retire": Retire,
    "bring-back": BringBack,
    "join": Join,
    "mishap": Mishap,
    "cut-motors": CutMotors,
    "acknowledge": Acknowledge,
}
"""The body of each command, at `/api/` and its name."""


class PlanEdit(TypedDict):
    """The plan, as it shall be from now on."""

    revision: int
    """The revision that was changed; if there is a newer one, that is answered, with 409."""
    missions: list[PlanMission]


class ExampleEdit(TypedDict):
    """Where an example is to be added."""

    revision: int
