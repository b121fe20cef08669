"""The drones of a fleet file: `[[drone]]`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING

from ..shared.alone.files import read_drones
from ..shared.domain import values
from ..shared.domain.errors import BadInput
from ..shared.domain.fleet_data import DroneData
from ..shared.domain.text import quoted
from ..shared.domain.values import Table
from .addresses import address_of
from .options import Options, options_in
from .reading import Document, PlanTable

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.airspace import Airspace

CRAZYFLIE = "crazyflie"
"""The default navigation."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneEntry(DroneData):
    """A drone of the fleet file, with how a real one is flown."""

    uri: str | None = None
    """The address of a real one, in its navigation's format."""
    navigation: str | None = None
    """How it is flown; None: as the fleet is."""
    options: Options = field(default_factory=dict)
    """Options for its navigation, which override the fleet's."""
    parameters: Mapping[str, float] = field(default_factory=dict)
    """What it is set to when it is connected to, by the names of its firmware."""
    line: int | None = None


def drones_of(
    top: PlanTable, app: App, airspace: Airspace | None, flown_by: str
) -> tuple[DroneEntry, ...]:
    """Return the drones of a fleet; `flown_by`: how it is flown, where a drone says nothing of that."""
    drones = list[DroneEntry]()
    uris = dict[str, Table]()
    for table, given in read_drones(top, app, airspace):
        navigation = table.value("navigation", values.name)
        uri = table.value("uri", partial(_uri, navigation or flown_by))
        _answers_alone(table, uris)
        drone = DroneEntry(
            **given,
            uri=uri,
            navigation=navigation,
            options=options_in(table.table("options")),
            parameters=table.value("parameters", _parameters) or {},
            line=table.document.line(table.path),
        )
        drones.append(drone)
    return tuple(drones)


def joining_drone(
    app: App,
    airspace: Airspace,
    flown_by: str,
    drones: Sequence[DroneEntry],
    data: Mapping[str, object],
) -> DroneEntry:
    """Read a drone that joins these, given as in a fleet file; raise `BadInput` with all that is wrong."""
    others = [_known(one) for one in drones]
    document = Document("", {"drone": [*others, {**data}]})
    *_, drone = drones_of(PlanTable(document, document.data), app, airspace, flown_by)
    document.refuse_if_bad()
    if drone.home[2] != 0.0:  # what is known of ways from the docks on the ground would not hold
        raise BadInput(
            f"drone {quoted(drone.id)}: a drone that joins has its dock on the ground: home = [x, y]"
        )
    return drone


def _known(drone: DroneEntry) -> dict[str, object]:
    """Return a drone as a fleet file has it, by what no other one may have."""
    table = {"id": drone.id, "category": drone.category, "home": [*drone.home]}
    own = {"uri": drone.uri, "navigation": drone.navigation}
    return {**table, **{key: value for key, value in own.items() if value is not None}}


def _answers_alone(table: Table, uris: dict[str, Table]) -> None:
    uri = table.data.get("uri")
    if isinstance(uri, str):
        other = uris.setdefault(which(uri), table)
        if other is not table:
            said = f"uri is that of {other.who}{other.where('uri')}: it would be one and the same drone"
            table.problem(said, "uri")


def _parameters(value: object) -> Mapping[str, float]:
    """Read them; TOML makes tables of names with a point that are not in quotes."""
    match value:
        case dict():
            return dict(_named(value, ""))
        case _:
            raise ValueError('is not a table: write { "locSrv.extPosStdDev" = 0.01 }')


def _named(table: Mapping[str, object], group: str) -> Iterator[tuple[str, float]]:
    for key, value in table.items():
        name = f"{group}{key}"
        if isinstance(value, dict):
            yield from _named(value, f"{name}.")
            continue
        try:
            yield name, values.real(value)
        except ValueError as error:
            raise ValueError(f"sets {quoted(name)} to what {error}") from None


def _uri(navigation: str, value: object) -> str:
    uri: str = values.name(value)
    if navigation == CRAZYFLIE:
        address_of(uri)
    return uri


def which(uri: str) -> str:
    """Return a drone's uri in a canonical form, whichever dongle it names.

    What is no address of a Crazyflie is compared as a text.
    """
    with suppress(ValueError):
        return address_of(uri.strip()).drone
    return uri.strip().casefold().partition("?")[0].rstrip("/")
