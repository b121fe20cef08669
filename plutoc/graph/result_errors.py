"""What can be wrong with what an app says of its results (P1)."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc.diagnostic import Diagnostic, Related, error
from plutoc.graph.wording import a_kind, either, meant, there_are
from plutoc.source import Source, Span
from plutoc.syntax.tree import Name
from plutoc_runtime.domain.quantities import Type, units_of


def unknown_way(source: Source, name: Name, known: Sequence[str]) -> Diagnostic:
    """A way to show results that does not exist."""
    return error(
        "P1053",
        f"results cannot be shown as `{name.text}`",
        source,
        name.span,
        help=meant(name.text, known) or there_are(known, "the ways"),
    )


def unfit_way(
    source: Source, way: Name, action: str, possible: Sequence[str], silent: bool
) -> Diagnostic:
    """A way to show results that the results of this action do not suit."""
    return error(
        "P1054",
        f"what `{action}` gives cannot be shown as `{way.text}`",
        source,
        way.span,
        label=f"`{action}` does not say what it gives" if silent else f"not for `{action}`",
        help=(
            f"say what it gives: `action {action} -> float`"
            if silent
            else f"it can be shown as {either(possible)}"
        ),
    )


def shown_twice(source: Source, span: Span, action: str, first: Span) -> Diagnostic:
    """Two statements that say how the same results are shown."""
    return error(
        "P1055",
        f"how the results of `{action}` are shown is said already",
        source,
        span,
        label="said once more",
        related=(Related(source, first, "said here"),),
        help="remove one of the two",
    )


def unfit_unit(source: Source, span: Span, unit: str, action: str, kind: Type) -> Diagnostic:
    """A unit in which the quantity that an action gives cannot be shown."""
    return error(
        "P1056",
        f"`{action}` gives {a_kind(kind)}, which cannot be shown in `{unit}`",
        source,
        span,
        label="another unit",
        help=f"{a_kind(kind)} has the units {either(units_of(kind))}",
    )
