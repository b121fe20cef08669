"""The drones of a fleet file: `[[drone]]`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING

from ..shared.domain import values
from ..shared.domain.errors import BadInput
from ..shared.domain.fleet_data import DroneData
from ..shared.domain.text import quoted
from ..shared.domain.values import Cells, crowded
from . import errors
from .addresses import address_of
from .options import Options, options_under
from .reading import Document, Table, shortened

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


def read_drones(
    top: Table, app: App, airspace: Airspace | None, flown_by: str
) -> tuple[DroneEntry, ...]:
    """Return the drones whose entries are valid; `flown_by`: the fleet's navigation."""
    drones: list[DroneEntry] = []
    ids: dict[str, Table] = {}
    uris: dict[str, Table] = {}
    homes = Cells()
    for index, table in enumerate(top.tables("drone", "drone")):
        drone = _drone(table, index, app, airspace, flown_by, ids, homes)
        _answers_alone(table, uris)
        if drone is not None:
            drones.append(drone)
    if top.data.get("drone", []) == []:
        top.problem(errors.none_given("drone"))
    return tuple(drones)


def joining_drone(
    app: App,
    airspace: Airspace,
    flown_by: str,
    drones: Sequence[DroneEntry],
    data: Mapping[str, object],
) -> DroneEntry:
    """Read a drone that joins these, given as in a fleet file; raise `BadInput` with all that is wrong."""
    document = Document("", {"drone": [{**data}]})
    table = Table(document, data, ("drone", 0))
    homes, ids, uris = Cells(), dict[str, Table](), dict[str, Table]()
    for one in drones:
        other = Table(document, {}, who=f"drone {quoted(one.id)}")
        crowded(one.home, one.id, homes)
        ids[one.id] = other
        if one.uri is not None:
            uris[which(one.uri)] = other
    drone = _drone(table, len(drones), app, airspace, flown_by, ids, homes)
    _answers_alone(table, uris)
    if document.problems or drone is None:
        raise BadInput(shortened([one.sentence for one in document.problems]))
    if drone.home[2] != 0.0:  # what is known of ways from the docks on the ground would not hold
        raise BadInput(f"{table.who}: a drone that joins has its dock on the ground: home = [x, y]")
    return drone


def named_navigations(top: Table, of_fleet: str) -> list[str]:
    """Return the navigations of all drones, also of entries with other mistakes."""
    tables = top.data.get("drone")
    entries = tables if isinstance(tables, list) else []
    own = [entry.get("navigation") for entry in entries if isinstance(entry, dict)]
    return list(dict.fromkeys([of_fleet, *(name for name in own if isinstance(name, str))]))


def _drone(
    table: Table,
    index: int,
    app: App,
    airspace: Airspace | None,
    flown_by: str,
    ids: dict[str, Table],
    homes: Cells,
) -> DroneEntry | None:
    known = table.valid_name("id")
    table.who = f"drone {index + 1 if known is None else quoted(known)}"
    table.only(("id", "category", "home", "uri", "navigation", "options", "parameters"), "a drone")
    name = table.read("id", values.name, required=True)
    if name is not None:
        table.differs("drone", "id", name, ids)
    category = _category(table, app)
    home = table.position("home", airspace, 0.0, required=True)
    navigation = table.read("navigation", values.name)
    uri = table.read("uri", partial(_uri, navigation or flown_by))
    options = options_under(table, "options", "drone.options")
    parameters = table.read("parameters", _parameters)
    crowd = None if home is None else crowded(home, name or f"{index + 1}", homes)
    if crowd is not None:
        table.problem(crowd, "home")
    if name is None or category is None or home is None:
        return None
    return DroneEntry(
        id=name,
        category=category,
        home=home,
        uri=uri,
        navigation=navigation,
        options=options,
        parameters=parameters or {},
        line=table.line(),
    )


def _category(table: Table, app: App) -> str | None:
    names = [category.name for category in app.categories]
    if "category" not in table.data:
        if len(names) == 1:  # the only category is the default
            return names[0]
        table.problem(errors.category_missing(names))
        return None
    name = table.read("category", values.text)
    if name is not None and name not in names:
        table.problem(errors.unknown_name("category", name, names, "this app has"), "category")
        return None
    return name


def _answers_alone(table: Table, uris: dict[str, Table]) -> None:
    uri = table.data.get("uri")
    if isinstance(uri, str):
        other = uris.setdefault(which(uri), table)
        if other is not table:
            table.problem(errors.shared_uri(other.who, other.line("uri")), "uri")


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
