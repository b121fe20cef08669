"""What can be wrong with names, packages and hooks (P1). Edges and values: files of their own."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc.block import IN_GRAPH
from plutoc.diagnostic import Diagnostic, Related, error, warning
from plutoc.edits import without_item, without_statement
from plutoc.graph.names import LONGEST, Style, in_plain_letters, in_snake_case
from plutoc.graph.wording import (
    all_of,
    alternatives,
    either,
    meant,
    strange_letter,
    there_are,
)
from plutoc.source import Source, Span
from plutoc.syntax.tree import Name
from plutoc_runtime.domain.quantities import UNITS, Type


def malformed_name(source: Source, name: Name) -> Diagnostic:
    """A name with other characters, or too many."""
    label = strange_letter(name.text) or ""
    if len(name.text) > LONGEST:
        message = f"this name has {len(name.text)} characters; {LONGEST} are the most"
        help = "choose a shorter one"
    else:
        message = f"`{name.text}` is not a name: names have only the letters a to z, digits and `_`"
        plain = in_plain_letters(name.text)
        help = f"for instance `{plain}`" if plain else "choose a plain name"
    return error("P1001", message, source, name.span, label=label, help=help)


def wrong_style(source: Source, name: Name, role: str, style: Style) -> Diagnostic:
    """A name written as those of another role are."""
    snake = in_snake_case(name.text) if style is Style.SNAKE else None
    return error(
        "P1002",
        f"{role} is written in {style.value}, and `{name.text}` is not",
        source,
        name.span,
        help=f"write `{snake}`, here and wherever it is used" if snake else None,
    )


def reserved_name(source: Source, name: Name, whose: str) -> Diagnostic:
    """A name that means something else already."""
    return error(
        "P1003",
        f"nothing can be named `{name.text}`: it is {whose}",
        source,
        name.span,
        label="choose another name",
    )


def taken_app_name(source: Source, name: Name, whose: str) -> Diagnostic:
    """An app whose package would hide another one."""
    return error(
        "P1004",
        f"an app cannot be named `{name.text}`: its package would have the name of {whose}",
        source,
        name.span,
        label="choose another name",
        help=f"for instance `{in_snake_case(name.text)}_app`",
    )


def declared_twice(
    source: Source, name: Name, role: str, first: Name, first_role: str
) -> Diagnostic:
    """Two declarations of one name."""
    one, other = (source.line(source.position(n.span.start)[0]).strip() for n in (first, name))
    same = one == other and first.span.start != name.span.start
    return error(
        "P1005",
        f"`{name.text}` is declared twice" + _as(role, first_role),
        source,
        name.span,
        label="the second time",
        related=(Related(source, first.span, "the first time"),),
        help="remove one of them" if same else "give one of them another name",
    )


def differs_in_case_only(source: Source, name: Name, first: Name) -> Diagnostic:
    """Two names that a reader, or a file system, takes for one."""
    return error(
        "P1006",
        f"`{name.text}` and `{first.text}` differ only in upper and lower case",
        source,
        name.span,
        related=(Related(source, first.span, f"`{first.text}`"),),
        help="give one of them another name",
    )


def built_in_name(source: Source, name: Name, what: str, along: bool = False) -> Diagnostic:
    """A declaration with the name of an action or an event that every app has."""
    also = f"; to have it done on the way, write `action {name.text} along`" if along else ""
    return error(
        "P1007",
        f"`{name.text}` is {what} that every app has",
        source,
        name.span,
        label="declared once more",
        help=f"remove this declaration to use that one, or choose another name{also}",
    )


def _as(role: str, first_role: str) -> str:
    return "" if role == first_role else f": as {first_role} and as {role}"


def unknown_package(source: Source, name: Name, installed: Sequence[str]) -> Diagnostic:
    """`use` of what is not installed."""
    return error(
        "P1008",
        f"no package of blocks named `{name.text}` is installed",
        source,
        name.span,
        help=meant(name.text, installed)
        or "install it with pip into the environment that plutoc runs in",
    )


def broken_package(source: Source, package: str, span: Span, sentence: str) -> Diagnostic:
    """A package of blocks that does not load."""
    return error(
        "P1009",
        f"`{package}` cannot be used: {sentence}",
        source,
        span,
        help="tell the people who made that package, or install another version of it",
    )


def unused_package(source: Source, name: Name, span: Span) -> Diagnostic:
    """`use` of what no block comes from."""
    return warning(
        "P1010",
        f"no block of `{name.text}` is used",
        source,
        span,
        label="not needed",
        help="remove this line",
        fix=without_statement(source, span),
    )


def unknown_prefix(source: Source, prefix: Name, prefixes: Sequence[str]) -> Diagnostic:
    """A kind of a package that the file does not `use`."""
    return error(
        "P1011",
        f"this file uses no package called `{prefix.text}`",
        source,
        prefix.span,
        help=meant(prefix.text, prefixes)
        or f"write `use {prefix.text}` above the app, or leave the prefix out",
    )


def unknown_kind(
    source: Source,
    kind: Name,
    package: str | None,
    kinds: Sequence[str],
    fitting: Sequence[str],
    elsewhere: Sequence[str],
) -> Diagnostic:
    """A block of a kind that does not exist; `fitting` are similar ones, with what it is given."""
    where = f"`{package}` has no kind of block" if package else "there is no kind of block"
    return error(
        "P1012",
        f"{where} named `{kind.text}`",
        source,
        kind.span,
        help=alternatives(elsewhere, "write ", "")
        or meant(kind.text, fitting)
        or there_are(kinds, "kinds"),
    )


def unknown_action(source: Source, name: Name, known: Sequence[str]) -> Diagnostic:
    """A category that can do what is not an action."""
    return error(
        "P1024",
        f"there is no action `{name.text}`",
        source,
        name.span,
        help=meant(name.text, known) or f"declare it in the app: `action {name.text}`",
    )


def named_twice(source: Source, name: Name, first: Name) -> Diagnostic:
    """The same word twice in one list."""
    return warning(
        "P1025",
        f"`{name.text}` is named twice here",
        source,
        name.span,
        label="the second time",
        related=(Related(source, first.span, "the first time"),),
        help="remove one of them",
        fix=without_item(source, name.span),
    )


_OTHER_TYPES = {
    **dict.fromkeys(("str", "string", "char"), "text"),
    **dict.fromkeys(("boolean", "truth", "flag"), "bool"),
    **dict.fromkeys(("integer", "long", "whole"), "int"),
    **dict.fromkeys(("double", "number", "real", "decimal"), "float"),
    **dict.fromkeys(("gram", "kilogram", "weight"), "mass"),
    **dict.fromkeys(("metre", "meter", "distance", "height"), "length"),
    **dict.fromkeys(("second", "seconds", "minute", "minutes", "duration", "delay"), "time"),
    **dict.fromkeys(("degree", "degrees", "radian", "heading"), "angle"),
    **dict.fromkeys(("share", "ratio", "percentage", "fraction"), "percent"),
    **dict.fromkeys(("velocity",), "speed"),
    **dict.fromkeys(("celsius", "kelvin"), "temperature"),
}
"""What other languages and people call them."""


_TYPES = tuple(kind.value for kind in Type)


def unknown_type(
    source: Source, name: Name, known: Sequence[str] = _TYPES, mended: str | None = None
) -> Diagnostic:
    """A parameter, a field or a result of a type that the language does not know."""
    other = _OTHER_TYPES.get(name.text.lower())
    measured = UNITS[name.text][0].value if name.text in UNITS else None
    if mended:
        help = f"write {mended}"
    elif name.text.lower() in ("none", "nothing", "void", "null"):
        help = "where there is nothing to say, leave the type out"
    elif measured:
        help = f"`{name.text}` is a unit: the type is `{measured}`"
    elif other:
        help = f"did you mean `{other}`?"
    else:
        help = meant(name.text, known) or f"types are {either(known)}"
    return error(
        "P1026",
        f"there is no type `{name.text}`",
        source,
        name.span,
        help=help,
    )


def unknown_repeat(
    source: Source, name: Name, known: Sequence[str], types: Sequence[str]
) -> Diagnostic:
    """A last word of an action that is none of those that there are."""
    return error(
        "P1027",
        f"an action ends with {either(known)}, not with `{name.text}`",
        source,
        name.span,
        help=(
            f"what it gives stands behind an arrow: `-> {name.text}`"
            if name.text in types
            else meant(name.text, known)
        ),
    )


def unknown_duration(
    source: Source, name: Name, given: Sequence[str], timed: Sequence[str]
) -> Diagnostic:
    """What an action takes is a name, and not that of one of its parameters that are times."""
    if name.text in given:
        what = f"the parameter `{name.text}` is no time, so it cannot say how long the action takes"
    else:
        what = f"the action has no parameter `{name.text}` that could say how long it takes"
    return error(
        "P1057",
        what,
        source,
        name.span,
        help=meant(name.text, timed)
        or f"write a time, such as `takes 3 min`, or {_a_timed(timed)}",
    )


def _a_timed(timed: Sequence[str]) -> str:
    if not timed:
        return "a parameter of the type `time`"
    return f"its parameter {either(timed)}"


_OTHER_STATUSES = {
    **dict.fromkeys(("DONE", "SUCCESS", "SUCCEEDED", "FINISHED", "COMPLETE", "OK"), "COMPLETED"),
    **dict.fromkeys(("ERROR", "FAILURE", "FAIL", "CRASHED", "TIMEOUT"), "FAILED"),
    **dict.fromkeys(("IDLE", "WAITING", "READY", "NEXT"), "STANDBY"),
    **dict.fromkeys(("NEW", "CREATED", "INITIAL", "PENDING"), "UNEXECUTED"),
    **dict.fromkeys(("FLYING", "EXECUTING", "BUSY", "ACTIVE"), "RUNNING"),
}
"""What other programs call them."""


def unknown_status(source: Source, name: Name, legal: Sequence[str]) -> Diagnostic:
    """A status that does not exist; `legal` are those that could stand here."""
    other = _OTHER_STATUSES.get(name.text.upper())
    return error(
        "P1028",
        f"there is no status `{name.text}`",
        source,
        name.span,
        help=(
            f"did you mean `{other}`?"
            if other in legal
            else meant(name.text, legal) or alternatives(legal, "only ", " can stand here")
        ),
    )


def status_outside_graph(source: Source, name: Name) -> Diagnostic:
    """A status that no block ever sees."""
    return error(
        "P1029",
        f"no block sees a mission that is {name.text}",
        source,
        name.span,
        label="a status outside the graph",
        help=f"blocks and edges know {all_of([status.value for status in IN_GRAPH])}",
    )


def unused_hook(source: Source, name: Name, role: str) -> Diagnostic:
    """A hook that no block calls."""
    return warning(
        "P1030",
        f"the {role} `{name.text}` is declared but no block uses it",
        source,
        name.span,
        label="not used",
        help="name it in a block, or remove it",
    )


def unused_action(source: Source, name: Name) -> Diagnostic:
    """An action that no drone can do."""
    return warning(
        "P1031",
        f"no category can do `{name.text}`",
        source,
        name.span,
        label="not used",
        help=f"add it to a category: `can …, {name.text}`, or remove it",
    )


def clashing_parameter(source: Source, name: Name, owner: str) -> Diagnostic:
    """A parameter with the name of something that its hook gets anyway."""
    what = f"a parameter of {owner}", "its hook gets that already"
    if owner == "an event":
        what = "a field of an event", "every event has that"
    return error(
        "P1038",
        f"{what[0]} cannot be named `{name.text}`: {what[1]}",
        source,
        name.span,
        label="choose another name",
    )
