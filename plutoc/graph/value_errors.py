"""What can be wrong with the values in parentheses (P1)."""

from __future__ import annotations

from collections.abc import Container, Sequence

from plutoc.diagnostic import Diagnostic, Fix, Related, error
from plutoc.graph.model import Hook, Node, Parameter
from plutoc.graph.wording import a_kind, either, meant, there_are, unit_meant
from plutoc.source import Source, Span
from plutoc.syntax.texts import written_out
from plutoc.syntax.tree import Name, Quantity
from plutoc_runtime.domain.quantities import UNITS, Type, units_of


def unknown_argument(
    source: Source, name: Name, owner: str, known: Sequence[str], given: Container[str]
) -> Diagnostic:
    """A value for a parameter that does not exist."""
    free = [each for each in known if each not in given]
    return error(
        "P1013",
        f"{owner} has no parameter `{name.text}`",
        source,
        name.span,
        help=meant(name.text, free) or there_are(known, "parameters") or "it has none at all",
    )


def argument_twice(source: Source, name: Name, first: Span) -> Diagnostic:
    """Two values for one parameter."""
    return error(
        "P1014",
        f"`{name.text}` is given twice",
        source,
        name.span,
        label="the second time",
        related=(Related(source, first, "the first time"),),
        help="remove one of them",
    )


def missing_argument(source: Source, span: Span, owner: str, name: str, example: str) -> Diagnostic:
    """A parameter that has to be given, and is not."""
    return error(
        "P1015",
        f"{owner} needs `{name}`",
        source,
        span,
        label=f"`{name}` is missing",
        help=f"write `{name}: {example}` in its parentheses",
    )


def wrong_type(
    source: Source, span: Span, name: str, wanted: str, example: str, mended: str | None = None
) -> Diagnostic:
    """A value of another type; `mended` is how this very value is written."""
    return error(
        "P1016",
        f"`{name}` takes {wanted}",
        source,
        span,
        label=f"not {wanted}",
        help=f"write `{mended}`" if mended else f"for instance `{example}`",
        fix=Fix(span=span, text=mended) if mended else None,
    )


def unknown_unit(
    source: Source, span: Span, name: str, unit: str, kind: Type, example: str
) -> Diagnostic:
    """A unit that the language does not know."""
    units = units_of(kind)
    if units:
        help = unit_meant(unit, units) or f"{a_kind(kind)} has the units {either(units)}"
    else:
        help = f"`{name}` has none: for instance `{example}`"
    return error(
        "P1017",
        f"there is no unit `{unit}`",
        source,
        span,
        label="unknown unit",
        help=written_out(source.quote(span)) or help,
    )


def missing_unit(source: Source, span: Span, name: str, kind: Type) -> Diagnostic:
    """A number where a quantity is wanted."""
    from decimal import Decimal  # only for mistakes

    number = source.quote(span)
    help = "write " + either([f"{number} {unit}" for unit in units_of(kind)])
    if kind is Type.PERCENT and 0 < Decimal(number) <= 1:
        hundredths = format((Decimal(number) * 100).normalize(), "f")
        help = f"write `{hundredths} %`: a share is said in hundredths"
    return error(
        "P1018",
        f"`{name}` is {a_kind(kind)} and needs a unit",
        source,
        span,
        label="the unit is missing",
        help=help,
    )


_MIXED_UP = {
    ("m", Type.TIME): "min",
    ("m", Type.SPEED): "m/s",
    ("ms", Type.SPEED): "m/s",
    ("km", Type.SPEED): "km/h",
    ("ms", Type.LENGTH): "m",
    ("km", Type.MASS): "kg",
    ("C", Type.ANGLE): "deg",
    ("deg", Type.TEMPERATURE): "C",
}
"""The unit that was probably meant by one that measures something else."""


def wrong_dimension(
    source: Source, name: str, value: Quantity, kind: Type, wanted: str, *, certain: bool
) -> Diagnostic:
    """A quantity of something else; `certain`: no other type can be meant for the parameter."""
    given, units = UNITS[value.unit][0], units_of(kind)
    number = source.quote(value.span).removesuffix(value.unit).rstrip()
    likely = _MIXED_UP.get((value.unit, kind))
    fix = None
    if likely == "min":
        help = f"write `{number} min`: `m` is the metre, never the minute"
        if certain and value.value > 0:
            fix = Fix(span=value.span, text=f"{number} min")
    elif units:
        question = f"did you mean `{number} {likely}`? " if likely else ""
        help = f"{question}{a_kind(kind)} has the unit{'s' * (len(units) > 1)} {either(units)}"
    else:
        help = f"`{name}` has no unit"
    return error(
        "P1019",
        f"`{name}` takes {wanted}, and this is {a_kind(given)}",
        source,
        value.span,
        label=a_kind(given),
        help=help,
        fix=fix,
    )


def out_of_range(source: Source, span: Span, name: str, rule: str) -> Diagnostic:
    """A value beyond what is possible."""
    return error("P1020", f"`{name}` must be {rule}", source, span, label=f"must be {rule}")


def unknown_option(
    source: Source,
    span: Span,
    param: str,
    given: str,
    options: Sequence[str],
    possible: Sequence[str],
    hook: str | None,
) -> Diagnostic:
    """A choice that is none of the given ones."""
    or_hook = f", and no {hook} of that name is declared" if hook else ""
    return error(
        "P1021",
        f"`{param}` cannot be `{given}`: it is none of {either(options)}{or_hook}",
        source,
        span,
        help=meant(given, possible),
    )


def unknown_hook(
    source: Source, span: Span, given: str, kind: str, known: Sequence[str]
) -> Diagnostic:
    """A hook that is not declared."""
    return error(
        "P1022",
        f"no {kind} `{given}` is declared",
        source,
        span,
        label="not declared",
        help=meant(given, known) or f"declare it in the app: `{kind} {given}`",
    )


def wrong_hook(
    source: Source, span: Span, given: str, wanted: str, role: str, declared: Span
) -> Diagnostic:
    """A hook of another kind."""
    return error(
        "P1023",
        f"`{given}` is {role}; {wanted} is wanted here",
        source,
        span,
        related=(Related(source, declared, f"declared as {role}"),),
    )


def chosen_without_a_value(
    source: Source, span: Span, hook: Hook, parameter: Parameter, node: Node, default: str
) -> Diagnostic:
    """A parameter without a default, of a hook that a mission may choose instead of a block's own."""
    return error(
        "P1052",
        f"a mission may choose `{hook.name}` at `{node.name}`, and its `{parameter.name}` has no"
        " value there",
        source,
        span,
        label="has no default",
        related=(Related(source, node.span, "what is given here is for its own hook alone"),),
        help=f"give it a default: `{default}`",
    )
