"""`tests/test_flow.py`: the app flies a small plan in simulation."""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.emit.markup import toml_text
from plutoc.emit.render import render
from plutoc.graph.model import Action, Category, Graph
from plutoc_runtime.domain.actions import BUILT_IN, PICK, RELEASE
from plutoc_runtime.domain.fields import Entity
from plutoc_runtime.domain.quantities import Type

_SAMPLES = {Type.INT: "1", Type.BOOL: "true", Type.TEXT: '"text"', Type.PERCENT: "0.5"}
"""What a trip gives for a parameter without a default; for all other types, 1.0."""

_TARGETS = ("[3.0, 4.0]", "[6.0, 2.5]")
"""Near the drones of a plain of 20 × 20 m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MissionTable:
    """A `[[mission]]`, in TOML."""

    name: str
    fields: list[str]
    """`name = value`, of what must be filled in."""
    trips: list[str]
    actions: tuple[str, ...]
    """What its drone must be able to do."""


def flow_test(graph: Graph) -> str:
    """Return the text of `tests/test_flow.py`, not yet formatted."""
    return render("test_flow.py", app=graph.name, missions=_missions(graph))


def sample(graph: Graph) -> MissionTable:
    """Return a mission that the app's drones can fly."""
    return _missions(graph)[0]


def _missions(graph: Graph) -> list[MissionTable]:
    """Return a mission for each action; items only where drones can do nothing else."""
    own = {action.name: action for action in graph.actions if not action.along}
    can = [name for name in (*BUILT_IN, *own) if able(graph, name)]
    needed = _needed(graph, Entity.MISSION)
    fields = "".join(f", {given}" for given in _needed(graph, Entity.TRIP))
    simple = [name for name in can if name not in (PICK, RELEASE)]
    if not simple:
        parcel = toml_text("parcel")
        trips = [f"{trip}{fields}" for trip in _parcel(graph)]
        return [MissionTable(name=parcel, fields=needed, trips=trips, actions=(PICK, RELEASE))]
    return [
        MissionTable(
            name=toml_text(name),
            fields=needed,
            trips=[f"{_trip(name, own.get(name), target)}{fields}" for target in _TARGETS],
            actions=(name,),
        )
        for name in simple
    ]


def _needed(graph: Graph, on: Entity) -> list[str]:
    """Return the fields of the app's own that must be filled in, as TOML."""
    fields = [one for one in graph.fields if one.on is on and one.default is None]
    return [f"{one.name} = {_SAMPLES.get(one.type, '1.0')}" for one in fields]


def able(graph: Graph, *actions: str) -> Category | None:
    """Return the first category of drones that can do all of this."""
    can = (one for one in graph.categories if one.actions is None or {*actions} <= {*one.actions})
    return next(can, None)


def _trip(name: str, action: Action | None, target: str) -> str:
    trip = f"action = {toml_text(name)}, target = {target}"
    needed = [one for one in action.parameters if one.default is None] if action else []
    if needed:
        given = ", ".join(f"{one.name} = {_SAMPLES.get(one.type, '1.0')}" for one in needed)
        trip += f", parameters = {{ {given} }}"
    return trip


def _parcel(graph: Graph) -> list[str]:
    """Return trips that take an item somewhere: a plan for drones that do nothing else."""
    mass = min(category.payload for category in graph.categories)
    item = f'{{ name = "parcel", mass = {mass!r} }}'
    return [
        f"action = {toml_text(name)}, target = {target}, item = {item}"
        for name, target in zip((PICK, RELEASE), _TARGETS, strict=True)
    ]
