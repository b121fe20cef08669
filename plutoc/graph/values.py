"""Values of the source: checked against a type, made SI, and written out again."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc.diagnostic import Diagnostic
from plutoc.graph import value_errors
from plutoc.graph.model import Plain
from plutoc.graph.wording import a_kind
from plutoc.source import Source
from plutoc.syntax.tree import Argument, Bool, List, Name, Number, Quantity, Text, Value
from plutoc_runtime.domain.quantities import QUANTITIES, UNITS, Type, to_si

_WANTED = {
    Type.INT: "a whole number",
    Type.FLOAT: "a number",
    Type.BOOL: "`yes` or `no`",
    Type.TEXT: "a text in quotes",
}

_YES_OR_NO = {"true": "yes", "True": "yes", "false": "no", "False": "no"}
"""What other languages say."""

EXAMPLES = {
    Type.INT: "3",
    Type.FLOAT: "0.5",
    Type.BOOL: "yes",
    Type.TEXT: '"text"',
    Type.MASS: "50 mg",
    Type.LENGTH: "2 m",
    Type.TIME: "5 min",
    Type.ANGLE: "90 deg",
    Type.PERCENT: "40 %",
    Type.SPEED: "0.5 m/s",
    Type.TEMPERATURE: "20 C",
}
"""A value of each type, for messages."""


def typed(
    source: Source,
    name: str,
    value: Value,
    kind: Type,
    found: list[Diagnostic],
    *,
    ours: bool = False,
) -> Plain | None:
    """Return the value in SI units, or None where it is not of that type.

    `ours`: the language says the type, and not the app, where the type itself may be the mistake.
    """
    match value:
        case Number(value=number) if kind is Type.FLOAT:
            return float(number)
        case Number(value=int() as number) if kind is Type.INT:
            return number
        case Bool(value=yes) if kind is Type.BOOL:
            return yes
        case Text(value=text) if kind is Type.TEXT:
            return text
        case Quantity():
            return _quantity(source, name, value, kind, found, ours)
        case Number() if kind in QUANTITIES:
            found.append(value_errors.missing_unit(source, value.span, name, kind))
        case _:
            example = f"{name}: {EXAMPLES[kind]}"
            mended = _YES_OR_NO.get(written(value)) if kind is Type.BOOL else None
            found.append(
                value_errors.wrong_type(source, value.span, name, wanted(kind), example, mended)
            )
    return None


def _quantity(
    source: Source, name: str, value: Quantity, kind: Type, found: list[Diagnostic], ours: bool
) -> float | None:
    if value.unit not in UNITS:
        example = f"{name}: {EXAMPLES[kind]}"
        unknown = value_errors.unknown_unit(source, value.span, name, value.unit, kind, example)
        found.append(unknown)
        return None
    if UNITS[value.unit][0] is not kind:
        what = wanted(kind)
        found.append(value_errors.wrong_dimension(source, name, value, kind, what, certain=ours))
        return None
    si = to_si(value.value, value.unit)
    if kind is Type.PERCENT and not 0 <= si <= 1:
        found.append(value_errors.out_of_range(source, value.span, name, "from 0 % to 100 %"))
        return None
    if kind is Type.TEMPERATURE and si < 0:
        found.append(value_errors.out_of_range(source, value.span, name, "0 K (-273.15 C) or more"))
        return None
    return si


def wanted(kind: Type) -> str:
    """Say what a parameter of that type takes: "a mass"."""
    return _WANTED.get(kind) or a_kind(kind)


def at_least(least: float, kind: Type) -> str:
    """Say a lower bound, which is in SI units, with its unit."""
    unit = next((unit for unit, (of, factor, _) in UNITS.items() if of is kind and factor == 1), "")
    if kind is Type.PERCENT:
        least, unit = least * 100, "%"
    return f"{_digits(least)} {unit}".strip() + " or more"


def written(value: Value) -> str:
    """Return the value as the formatter would write it; of a text, not what it says."""
    match value:
        case Number():
            return _digits(value.value)
        case Quantity():
            return f"{_digits(value.value)} {value.unit}"
        case Bool():
            return "yes" if value.value else "no"
        case Text():
            return '"…"'
        case Name():
            return value.text
        case List():
            return f"[{', '.join(map(written, value.items))}]"


def _digits(number: float) -> str:
    """Write a number without an exponent, which the language does not have."""
    written = repr(int(number) if number == int(number) else number)
    if "e" not in written:
        return written
    from decimal import Decimal  # dear to load, and seldom needed

    return format(Decimal(written), "f")


def once_each(
    source: Source, arguments: Sequence[Argument], found: list[Diagnostic]
) -> list[Argument]:
    """Return the arguments without those that are given a second time."""
    first: dict[str, Argument] = {}
    for argument in arguments:
        before = first.setdefault(argument.name.text, argument)
        if before is not argument:
            found.append(value_errors.argument_twice(source, argument.name, before.name.span))
    return list(first.values())
