"""What can be wrong with events and with actions on the way (P1)."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc.diagnostic import Diagnostic, error, warning
from plutoc.edits import without_statement
from plutoc.graph.wording import all_of, meant, there_are
from plutoc.source import Source, Span
from plutoc.syntax.tree import EventDecl, Name


def takes_along(source: Source, where: Span, action: str) -> Diagnostic:
    """An action on the way that says how long it takes."""
    return error(
        "P1058",
        f"`{action}` is done along the way, and takes as long as its flight",
        source,
        where,
        help="leave `takes` out",
    )


def never_along(source: Source, name: Name, possible: Sequence[str]) -> Diagnostic:
    """A built-in action that a drone can do only at its target."""
    return error(
        "P1059",
        f"`{name.text}` cannot be done along the way",
        source,
        name.span,
        help=f"of the built-in actions, {all_of(possible)} can",
    )


def only_along(source: Source, where: Span, action: str) -> Diagnostic:
    """A built-in action that is declared with more than the word `along`."""
    return error(
        "P1059",
        f"`{action}` is built in: what it needs and gives is known",
        source,
        where,
        help=f"write `action {action} along`, and no more",
    )


def unknown_event(source: Source, name: Name, role: str | None, known: Sequence[str]) -> Diagnostic:
    """A block that waits for what is not an event."""
    said = f"`{name.text}` is {role}, not an event" if role else f"there is no event `{name.text}`"
    declare = f"declare it in the app: `event {name.text}`"
    return error(
        "P1060",
        said,
        source,
        name.span,
        help=meant(name.text, known) or (there_are(known, "events") if role else declare),
    )


def unused_event(source: Source, declared: EventDecl) -> Diagnostic:
    """An event that is declared, and that nothing waits for."""
    return warning(
        "P1061",
        f"nothing waits for the event `{declared.name.text}`",
        source,
        declared.name.span,
        label="declared, and not used",
        help=f"lead it to a block that makes a mission of it, `{declared.name.text} -> BLOCK`, or "
        "let a block that breaks a flight off wait for it",
        fix=without_statement(source, declared.span),
    )
