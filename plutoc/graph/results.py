"""`result ACTION as WAY(…)`: what the results of an action are, and how they are shown."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from plutoc.block import Param
from plutoc.diagnostic import Diagnostic
from plutoc.graph import errors as errors_of_names
from plutoc.graph import result_errors as errors
from plutoc.graph import value_errors
from plutoc.graph.built_in import ACTIONS
from plutoc.graph.hooks import PHOTO
from plutoc.graph.model import Action, Plain, Shown
from plutoc.graph.uncertain_names import UncertainNames
from plutoc.graph.values import once_each, typed, written
from plutoc.source import Source
from plutoc.syntax.tree import Argument, ResultDecl, Statement
from plutoc_runtime.domain.actions import MEASURE, PICK, RELEASE
from plutoc_runtime.domain.actions import PHOTO as TAKE_PHOTO
from plutoc_runtime.domain.quantities import QUANTITIES, Type, units_of
from plutoc_runtime.events.follow import FOLLOW

HEAT, VALUES, FINDINGS, PHOTOS, HANDLING = "heat", "values", "findings", "photos", "handling"

_LABEL = Param(name="label", type=Type.TEXT, doc="What the layer is called on the map.")
_NUMBER = (
    Param(name="quantity", type=Type.TEXT, doc="What the number is: `air pressure`."),
    Param(name="unit", type=Type.TEXT, doc="The unit of the number, as it is shown."),
    _LABEL,
    Param(name="low", type=Type.FLOAT, doc="The value at the lower end of the colours."),
    Param(name="high", type=Type.FLOAT, doc="The value at the upper end of the colours."),
)
_REACH = Param(
    name="reach", type=Type.LENGTH, doc="How far around its place a value says something."
)

WAYS: Mapping[str, tuple[Param, ...]] = {
    HEAT: (*_NUMBER, _REACH),
    VALUES: _NUMBER,
    FINDINGS: (_LABEL,),
    PHOTOS: (_LABEL,),
    HANDLING: (),
}
"""The ways in which results are shown, each with what can be said of them."""

SAID = {
    HEAT: "A coloured area between the places where a number was measured.",
    VALUES: "A number at each place, in the colours of a scale.",
    FINDINGS: "Pins where something was found: what a photo sees, a `yes`, or a text.",
    PHOTOS: "The ground that photos show, and the photos themselves, as one picture.",
    HANDLING: "Something that was done, and not a result: nothing is shown on the map.",
}
"""The same in a sentence each."""

_OF_NUMBERS, _OF_FINDINGS = (HEAT, VALUES), (FINDINGS,)
_FITS: Mapping[str, tuple[str, ...]] = {
    MEASURE: _OF_NUMBERS,
    TAKE_PHOTO: (PHOTOS, FINDINGS),
    FOLLOW.name: (PHOTOS, FINDINGS),
    PICK: (),
    RELEASE: (),
}


def results(
    source: Source,
    statements: Sequence[Statement],
    actions: Sequence[Action],
    partial: Collection[str],
    unclear: UncertainNames,
    found: list[Diagnostic],
) -> tuple[Shown, ...]:
    """Resolve what is said of results, and what the types of the app's own actions say.

    `partial` are actions with a mistake in their declaration: what they give is not certain.
    """
    own = {action.name: action for action in actions}
    said: dict[tuple[str, str, str], tuple[Shown, ResultDecl]] = {}
    for declared in (one for one in statements if isinstance(one, ResultDecl)):
        name, way = declared.action, declared.way.text
        if name.text not in own and name.text not in ACTIONS:
            if not unclear.may_declare(name.text):
                known = [*ACTIONS, *own]
                found.append(errors_of_names.unknown_action(source, name, known))
            continue
        if way not in WAYS:
            found.append(errors.unknown_way(source, declared.way, list(WAYS)))
            continue
        possible = (*ways_of(name.text, own.get(name.text)), HANDLING)
        if way not in possible and name.text not in partial:
            action = own.get(name.text)
            silent = action is not None and action.returns is None
            found.append(errors.unfit_way(source, declared.way, name.text, possible, silent))
            continue
        one = _shown(source, declared, own.get(name.text), found)
        first = next((d for key, (_, d) in said.items() if _clash(key, key_of(one))), None)
        if first is not None:
            found.append(errors.shown_twice(source, declared.span, name.text, first.span))
        else:
            said[key_of(one)] = one, declared
    spoken = {name for name, _, _ in said}
    implied = (one for action in actions if action.name not in spoken for one in _implied(action))
    return (*(one for one, _ in said.values()), *implied)


def ways_of(name: str, action: Action | None) -> tuple[str, ...]:
    """Return the ways in which an action's results can be shown; the first is how they are."""
    if action is None:
        return _FITS[name]
    if action.returns == PHOTO:
        return _FITS[TAKE_PHOTO]
    if action.returns in (Type.BOOL.value, Type.TEXT.value):
        return _OF_FINDINGS
    return (VALUES, HEAT) if action.returns else ()


def _implied(action: Action) -> Iterator[Shown]:
    """Yield how results are shown of which the app says no more than their type."""
    ways = ways_of(action.name, action)
    for way in ways[:1] if action.returns != PHOTO else ways:
        yield Shown(
            action=action.name,
            way=way,
            type=_number(action),
            given=(),
            declaration="",
            span=action.span,
        )


def _number(action: Action | None) -> Type | None:
    returns = action.returns if action else None
    kind = next((kind for kind in Type if kind.value == returns), None)
    return kind if kind not in (Type.BOOL, Type.TEXT) else None


def key_of(one: Shown) -> tuple[str, str, str]:
    """Return what may be said once: of a number, how that quantity is shown."""
    quantity = str(dict(one.given).get("quantity", "")) if one.action == MEASURE else ""
    return one.action, "number" if one.way in _OF_NUMBERS else one.way, quantity


def _clash(one: tuple[str, str, str], other: tuple[str, str, str]) -> bool:
    """Return whether two statements say the same, or one that there is nothing to show."""
    return one == other or (one[0] == other[0] and HANDLING in (one[1], other[1]))


def _shown(
    source: Source, declared: ResultDecl, action: Action | None, found: list[Diagnostic]
) -> Shown:
    params = {param.name: param for param in WAYS[declared.way.text]}
    owner = f"`{declared.way.text}`"
    names = {argument.name.text for argument in declared.arguments}
    given: dict[str, Plain] = {}
    for argument in once_each(source, declared.arguments, found):
        param = params.get(argument.name.text)
        if param is None:
            found.append(
                value_errors.unknown_argument(source, argument.name, owner, list(params), names)
            )
            continue
        value = typed(source, param.name, argument.value, param.type, found, ours=True)
        if value is not None and _is_possible(source, argument, value, given, action, found):
            given[param.name] = value
    if declared.action.text == MEASURE and "quantity" in params and "quantity" not in names:
        where = declared.way.span
        found.append(value_errors.missing_argument(source, where, owner, "quantity", '"pm10"'))
    return Shown(
        action=declared.action.text,
        way=declared.way.text,
        type=_number(action),
        given=tuple((name, given[name]) for name in params if name in given),
        declaration=_declaration(declared),
        span=declared.span,
    )


def _is_possible(
    source: Source,
    argument: Argument,
    value: Plain,
    before: Mapping[str, Plain],
    action: Action | None,
    found: list[Diagnostic],
) -> bool:
    name, span, kind = argument.name.text, argument.value.span, _number(action)
    rule = _unordered(name, value, before)
    if rule:
        found.append(value_errors.out_of_range(source, span, name, rule))
        return False
    if name == "reach" and isinstance(value, float) and value <= 0:
        found.append(value_errors.out_of_range(source, span, name, "more than 0 m"))
        return False
    if name in ("quantity", "unit", "label") and not str(value).strip():
        found.append(value_errors.out_of_range(source, span, name, "a text that is not empty"))
        return False
    if name == "unit" and kind in QUANTITIES and action and value not in units_of(kind):
        found.append(errors.unfit_unit(source, span, str(value), action.name, kind))
        return False
    return True


def _unordered(name: str, value: Plain, before: Mapping[str, Plain]) -> str:
    """Return the rule that one end of the colours breaks beside the other; empty: none."""
    low = value if name == "low" else before.get("low")
    high = value if name == "high" else before.get("high")
    if name not in ("low", "high") or not (isinstance(low, float) and isinstance(high, float)):
        return ""
    if low < high:
        return ""
    return f"less than `high`, {high:g}" if name == "low" else f"more than `low`, {low:g}"


def _declaration(declared: ResultDecl) -> str:
    given = ", ".join(f"{one.name.text}: {written(one.value)}" for one in declared.arguments)
    shown = f"result {declared.action.text} as {declared.way.text}"
    return f"{shown}({given})" if given else shown
