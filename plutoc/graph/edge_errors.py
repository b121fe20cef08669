"""What can be wrong with edges (P1)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from plutoc.block import IN_GRAPH
from plutoc.diagnostic import Diagnostic, Related, error
from plutoc.edits import line_below, without_arrow
from plutoc.graph.model import START, Hook
from plutoc.graph.names import Style, has_style, in_snake_case, reserved
from plutoc.graph.wording import all_of, alternatives, meant
from plutoc.source import Source, Span
from plutoc.syntax.tree import Name
from plutoc_runtime.domain.status import Status


def unknown_block(
    source: Source,
    name: Name,
    blocks: Sequence[str],
    role: str | None,
    of_kind: Sequence[str] = (),
) -> Diagnostic:
    """An edge from or to what is not a block; `of_kind` are blocks of the kind with its name."""
    snake = in_snake_case(name.text)
    if role:
        message = f"`{name.text}` is {role}, not a block"
        help = "only blocks stand in a flow: declare one with `NAME = KIND`"
    elif of_kind:
        message = f"`{name.text}` is a kind of block, and an arrow leads to a block"
        help = alternatives(of_kind, "did you mean ", "?") or ""
    else:
        message = f"there is no block `{name.text}`"
        kind = "KIND" if snake == name.text else name.text
        help = f"declare it in the app: `{snake} = {kind}`"
    return error("P1032", message, source, name.span, help=meant(name.text, blocks) or help)


def unknown_source(source: Source, name: Name, near: Sequence[str]) -> Diagnostic:
    """A flow that begins with what is neither a block nor an event."""
    snake = in_snake_case(name.text)
    kind = "KIND" if snake == name.text else name.text
    return error(
        "P1032",
        f"there is no block and no event `{name.text}`",
        source,
        name.span,
        help=meant(name.text, near)
        or f"declare it in the app: `{snake} = {kind}`, or `event {snake}`",
    )


def unknown_event(source: Source, name: Name, near: Sequence[str], creator: Hook) -> Diagnostic:
    """A flow that begins with no event, and leads to what makes missions of events."""
    right = has_style(name.text, Style.SNAKE) and not reserved(name.text)
    declared = f"event {name.text if right else in_snake_case(name.text)}"
    return error(
        "P1032",
        f"there is no event `{name.text}`",
        source,
        name.span,
        help=meant(name.text, near) or f"declare it in the app: `{declared}`",
        fix=line_below(source, creator.span, declared) if right and not near else None,
    )


def kind_in_a_flow(source: Source, name: Name, kind: Name) -> Diagnostic:
    """A declaration of a block, written with an arrow."""
    return error(
        "P1032",
        f"`{kind.text}` is a kind of block, and an arrow leads to a block",
        source,
        kind.span,
        help=f"to declare a block, write `{name.text} = {kind.text}`",
    )


def type_in_a_flow(source: Source, name: Name, kind: Name) -> Diagnostic:
    """A declaration of an action without its first word."""
    return error(
        "P1032",
        f"`{kind.text}` is a type, and an arrow leads to a block",
        source,
        kind.span,
        help=f"to declare an action, write `action {name.text} -> {kind.text}`",
    )


def into_start(source: Source, name: Name) -> Diagnostic:
    """An edge to where missions come from."""
    what = "every mission begins there once" if name.text == START else "it comes from outside"
    return error(
        "P1033",
        f"no edge leads to `{name.text}`: {what}",
        source,
        name.span,
        help=(
            "lead it to a block, for instance the one that gives the mission its next drone"
            if name.text == START
            else f'a hook raises it: `context.emit("{name.text}")`'
        ),
    )


def out_of_end(source: Source, name: Name) -> Diagnostic:
    """An edge from where missions end."""
    return error(
        "P1034",
        "no edge leaves `end`: missions are over there",
        source,
        name.span,
        help="`end` can only be the last stop",
    )


def edge_twice(
    source: Source, span: Span, guard: Span | None, first: Span, names: tuple[str, str]
) -> Diagnostic:
    """The same edge twice."""
    return error(
        "P1035",
        f"the edge from `{names[0]}` to `{names[1]}` is there twice",
        source,
        span,
        label="the second time",
        related=(Related(source, first, "the first time"),),
        help="remove one of them",
        fix=without_arrow(source, names, span, guard),
    )


def too_many_edges(source: Source, span: Span, most: int) -> Diagnostic:
    """Brackets that make more edges than can be meant."""
    return error(
        "P1039",
        f"an app has at most {most:,} edges, and with these it has more",
        source,
        span,
        label="each name in brackets leads to each in the next",
        help="let brackets of many names meet at a block, from which one edge goes on",
    )


def refused_status(
    source: Source, name: Name, target: str, kind: str | None, accepted: Iterable[Status]
) -> Diagnostic:
    """A guard with a status that the target does not accept."""
    what = f"`{target}` ({kind})" if kind else f"`{target}`"
    return error(
        "P1036",
        f"{what} does not accept {name.text}",
        source,
        name.span,
        label="not accepted",
        help=f"it accepts {all_of([status.value for status in IN_GRAPH if status in accepted])}",
    )


def guarded_start(source: Source, span: Span, name: str) -> Diagnostic:
    """A guard on an edge from `start`, or from an event."""
    return error(
        "P1037",
        f"an edge from `{name}` has no guard: nothing has happened to a mission there yet",
        source,
        span,
        help="remove the guard",
    )
