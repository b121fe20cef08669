"""A small plan that any app can fly, for one that has no missions file yet."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import cycle
from json import dumps

from plutoc.block import HookKind
from plutoc.emit.model_file import all_fields
from plutoc.graph.model import Category, Graph, Parameter
from plutoc_runtime.domain.actions import BUILT_IN, PICK, RELEASE
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.quantities import Type

_MISSIONS, _TRIPS = 3, 2
_HEAVIEST = 0.004
_VALUES = {
    Type.INT: "3",
    Type.FLOAT: "0.5",
    Type.BOOL: "true",
    Type.TEXT: '"text"',
    Type.MASS: '"50 mg"',
    Type.LENGTH: '"2 m"',
    Type.TIME: '"5 s"',
    Type.ANGLE: '"90 deg"',
    Type.PERCENT: '"40 %"',
    Type.SPEED: '"0.5 m/s"',
    Type.TEMPERATURE: '"20 C"',
}
"""A value of each type, as TOML has it."""


def sample_plan(graph: Graph) -> str:
    """Return a missions file for drones on an empty plain, as an app without a fleet file has them."""
    return "\n".join(_lines(graph)) + "\n"


def _lines(graph: Graph) -> Iterator[str]:
    yield f"# A plan for {graph.name} that was made up: {_MISSIONS} missions of {_TRIPS} trips."
    fields, actions = all_fields(graph), cycle(_pairs(graph))
    for mission in range(1, _MISSIONS + 1):
        yield from ("", "[[mission]]", f'name = "Mission {mission}"')
        yield from _values(graph, fields, Entity.MISSION, mission)
        for trip, action in enumerate(next(actions), 1):
            yield from ("", "  [[mission.trip]]", f"  action = {dumps(action)}")
            yield f"  target = [{3.0 * trip + mission}, {2.0 * mission + 1.0}]"
            if action in (PICK, RELEASE):
                yield f'  item = {{ name = "parcel", mass = {_mass(graph)} }}'
            given = _given(_parameters(graph, action))
            if given:
                yield f"  parameters = {{ {given} }}"
            yield from (f"  {one}" for one in _values(graph, fields, Entity.TRIP, mission))


def _pairs(graph: Graph) -> list[tuple[str, str]]:
    """Return the actions of missions: what is picked is released, everything else goes in turn."""
    own = (action.name for action in graph.actions if not action.along)
    known = dict.fromkeys([*BUILT_IN, *own])
    flown = graph.categories[:5]
    can = [name for name in known if any(c.actions is None or name in c.actions for c in flown)]
    single = [name for name in reversed(can) if name not in (PICK, RELEASE)]
    pairs = [(one, single[(i + 1) % len(single)]) for i, one in enumerate(single)]
    if any(_carries(category) for category in flown):
        pairs.insert(0, (PICK, RELEASE))
    return pairs or [("measure", "measure")]


def _carries(category: Category) -> bool:
    can = category.actions
    return category.payload > 0 and (can is None or {PICK, RELEASE} <= set(can))


def _mass(graph: Graph) -> str:
    most = max((c.payload for c in graph.categories if _carries(c)), default=_HEAVIEST)
    return f"{min(_HEAVIEST, most / 2):g}"


def _parameters(graph: Graph, action: str) -> tuple[Parameter, ...]:
    return next((one.parameters for one in graph.actions if one.name == action), ())


def _given(parameters: tuple[Parameter, ...]) -> str:
    needed = [one for one in parameters if one.default is None]
    return ", ".join(f"{one.name} = {_VALUES[one.type]}" for one in needed)


def _values(graph: Graph, fields: tuple[Field, ...], of: Entity, mission: int) -> Iterator[str]:
    """Yield the fields with which it is seen what they do, and none that may fail a mission."""
    for field in fields:
        if field.on is not of:
            continue
        match field.type:
            case FieldType.INT:
                yield f"{field.name} = {mission}"
            case FieldType.ROUNDS if mission == 1:
                yield f"{field.name} = 1"
            case FieldType.EVALUATOR:
                judges = [one.name for one in graph.hooks if one.kind is HookKind.EVALUATOR]
                if judges:
                    yield f"{field.name} = {dumps(judges[0])}"
            case Type() if field.hint:
                yield f"{field.name} = {_VALUES[field.type]}"
            case _:
                pass
