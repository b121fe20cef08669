"""Categories: what drones of one shape can carry and do (thesis 4.1)."""

from __future__ import annotations

from plutoc.block import Param
from plutoc.diagnostic import Diagnostic
from plutoc.graph import errors, value_errors
from plutoc.graph.model import Category
from plutoc.graph.uncertain_names import UncertainNames
from plutoc.graph.values import once_each, typed, written
from plutoc.source import Source
from plutoc.syntax.tree import Argument, CategoryDecl
from plutoc_runtime.domain.quantities import Type

IMPLICIT = "drone"
"""The name of the category of an app that declares none."""

PARAMS = (
    Param(name="payload", type=Type.MASS, doc="What it can carry.", default=0.01),
    Param(name="speed", type=Type.SPEED, doc="How fast it flies.", default=0.5),
    Param(name="flight_time", type=Type.TIME, doc="From a full battery.", default=420.0),
    Param(name="charge_time", type=Type.TIME, doc="To a full battery.", default=1200.0),
    Param(name="reserve", type=Type.PERCENT, doc="The charge to land with.", default=0.2),
)
_BY_NAME = {param.name: param for param in PARAMS}

_POSSIBLE = {
    "payload": (0.0, 1000.0, "from 0 g to 1000 kg"),
    "speed": (0.01, 100.0, "from 0.01 m/s to 100 m/s"),
    "flight_time": (1.0, 1e6, "from 1 s to 1000000 s"),
    "charge_time": (1.0, 1e6, "from 1 s to 1000000 s"),
}
"""The smallest and the largest, in SI units: a drone is never beyond, and arithmetic may be."""


def implicit() -> Category:
    """Return the category of an app that declares none: it can do everything."""
    return _category(IMPLICIT, {}, None, None)


def category(
    source: Source,
    declared: CategoryDecl,
    actions: dict[str, None],
    unclear: UncertainNames,
    found: list[Diagnostic],
) -> Category:
    """Resolve a category; `actions` are the names of all there are."""
    values: dict[str, float] = {}
    given = {argument.name.text for argument in declared.arguments}
    owner = f"category `{declared.name.text}`"
    for argument in once_each(source, declared.arguments, found):
        param = _BY_NAME.get(argument.name.text)
        if param is None:
            found.append(
                value_errors.unknown_argument(source, argument.name, owner, list(_BY_NAME), given)
            )
            continue
        value = typed(source, param.name, argument.value, param.type, found, ours=True)
        if isinstance(value, float) and _is_possible(source, param, argument, value, found):
            values[param.name] = value
    firsts = {name.text: name for name in reversed(declared.can)}
    others = [each for each in actions if each not in firsts]
    for name in declared.can:
        first = firsts[name.text]
        if name.text not in actions:
            if not unclear.may_declare(name.text):
                found.append(errors.unknown_action(source, name, others))
        elif first is not name:
            found.append(errors.named_twice(source, name, first))
    can = tuple(dict.fromkeys(name.text for name in declared.can))
    return _category(declared.name.text, values, can, declared)


def _is_possible(
    source: Source, param: Param, argument: Argument, value: float, found: list[Diagnostic]
) -> bool:
    if param.type is Type.PERCENT:
        possible, rule = value < 1, "less than 100 %"
    else:
        least, most, rule = _POSSIBLE[param.name]
        possible = least <= value <= most
    if not possible:
        found.append(value_errors.out_of_range(source, argument.value.span, param.name, rule))
    return possible


def _category(
    name: str,
    given: dict[str, float],
    actions: tuple[str, ...] | None,
    declared: CategoryDecl | None,
) -> Category:
    def value(param: str) -> float:
        default = _BY_NAME[param].default
        assert isinstance(default, float)
        return given.get(param, default)

    return Category(
        name=name,
        payload=value("payload"),
        speed=value("speed"),
        flight_time=value("flight_time"),
        charge_time=value("charge_time"),
        reserve=value("reserve"),
        actions=actions,
        declaration=_declaration(declared) if declared else "",
        span=declared.name.span if declared else None,
    )


def _declaration(declared: CategoryDecl) -> str:
    arguments = ", ".join(f"{a.name.text}: {written(a.value)}" for a in declared.arguments)
    given = f"({arguments})" if arguments else ""
    can = ", ".join(name.text for name in declared.can)
    return f"category {declared.name.text}{given} can {can}"
