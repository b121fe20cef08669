"""How values of parameters are written for people: in the unit that reads shortest."""

from __future__ import annotations

from plutoc_runtime.domain.quantities import QUANTITIES, UNITS, Type, to_si, units_of

Plain = bool | int | float | str


def amount(value: Plain | None, kind: Type) -> str:
    """Write a value: `5 min`, `3`, `yes`, or a text in quotes."""
    match value:
        case None:
            return "none"
        case bool():
            return "yes" if value else "no"
        case str():
            return code(f'"{value}"')
        case _ if kind in QUANTITIES:
            return _quantity(float(value), kind)
        case _:
            return f"{value:.12g}"


def code(text: str) -> str:
    """Put a text into backquotes, as it can stand in a sentence: with none of its own."""
    return f"`{text.replace('`', chr(39))}`"


def _quantity(value: float, kind: Type) -> str:
    """Write a quantity with as few digits as will do; of two ways, in the larger unit."""
    written = []
    for unit in sorted(units_of(kind), key=lambda unit: -UNITS[unit][1]):
        _, factor, offset = UNITS[unit]
        number = f"{(value - offset) / factor:.12g}"
        if "e" not in number and to_si(float(number), unit) == value:
            odd = value == 0 and factor != 1  # nothing at all is 0 s, and not 0 h
            written.append((len(number), odd, f"{number} {unit}"))
    return min(written, key=lambda one: one[:2])[-1] if written else f"{value:.12g}"
