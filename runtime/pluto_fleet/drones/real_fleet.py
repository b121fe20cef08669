"""The real drones of a fleet file, as plain data for the gateway's process."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ..files.fleet import OWN, navigation_of, options_of
from ..geodesy import LocalPlane
from ..jobs.reports import SILENCE
from ..shared.domain.actions import BUILT_IN, PHOTO, Plain
from ..shared.domain.model import Mission
from ..shared.events.declared import FOLLOWING

if TYPE_CHECKING:
    from ..files.fleet import FleetFile


@dataclass(frozen=True, slots=True, kw_only=True)
class RealDrone:
    """How one drone is flown."""

    id: str
    navigation: str
    """A name, or `module:Class`."""
    uri: str | None
    options: Mapping[str, object]
    parameters: Mapping[str, float] = field(default_factory=dict)
    """What it is set to when it is connected to."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RequiredAction:
    """A built-in action that the plan needs: a drone that cannot do it is not ready."""

    action: str
    parameters: Mapping[str, Plain]


@dataclass(frozen=True, slots=True, kw_only=True)
class RealFleet:
    """How all drones are flown."""

    drones: tuple[RealDrone, ...] = ()
    localization: str = OWN
    """Their localization: `own`, a name, or `module:Class`."""
    localization_options: Mapping[str, object] = field(default_factory=dict)
    tracker: str | None = None
    """What says where things are that move: a name, or `module:Class`."""
    tracker_options: Mapping[str, object] = field(default_factory=dict)
    wanted: tuple[RequiredAction, ...] = ()
    silence: float = SILENCE
    """Seconds for which a drone in the air may tell nothing before its flight fails."""
    plane: LocalPlane | None = None
    """Where the map lies on the Earth, if that is known."""


def real_fleet(
    fleet: FleetFile,
    missions: Iterable[Mission[Any]],
    uris: Mapping[str, str] | None = None,
    *,
    records: Iterable[Mapping[str, Any]] = (),
) -> RealFleet:
    """Return how a fleet's drones are flown for these missions; `uris` instead of the file's.

    `records`: the journal's records of resumed missions.
    """
    uris = uris or {}
    return RealFleet(
        drones=tuple(
            RealDrone(
                id=drone.id,
                navigation=navigation_of(fleet, drone),
                uri=uris.get(drone.id, drone.uri),
                options=options_of(fleet, drone),
                parameters=drone.parameters,
            )
            for drone in fleet.drones
        ),
        localization=fleet.localization,
        localization_options=fleet.localization_options,
        tracker=fleet.tracker,
        tracker_options=fleet.tracker_options,
        wanted=_wanted([*_planned(missions), *_recorded(records)]),
        silence=fleet.silence,
        plane=fleet.plane,
    )


def _planned(missions: Iterable[Mission[Any]]) -> Iterator[RequiredAction]:
    for mission in missions:
        for trip in mission.trips:
            yield RequiredAction(action=trip.action, parameters=dict(trip.parameters))
            if trip.action == FOLLOWING:
                yield RequiredAction(action=PHOTO, parameters={})
            if along := getattr(trip, "along", None):
                yield RequiredAction(
                    action=along["action"], parameters=dict(along.get("parameters") or {})
                )


def _recorded(records: Iterable[Mapping[str, Any]]) -> Iterator[RequiredAction]:
    """Yield the actions that resumed missions need; with further rounds, also those of completed trips."""
    for record in records:
        for trip in () if record["ended"] else (*record["done"], *record["todo"]):
            yield RequiredAction(action=trip["action"], parameters=trip.get("parameters", {}))


def _wanted(trips: Iterable[RequiredAction]) -> tuple[RequiredAction, ...]:
    """Return the actions that the trips need, each once, in their order."""
    found: list[RequiredAction] = []
    for wanted in trips:
        if wanted.action in BUILT_IN and wanted not in found:
            found.append(wanted)
    return tuple(found)
