"""The tree of a source: its statements as written, each with its place."""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.source import Source, Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Name:
    """A word that names something."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Number:
    """`3`, `-0.5`: whole numbers stay whole."""

    value: int | float
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """`5 min`, `40 %`: not yet converted, the unit not yet known to exist."""

    value: int | float
    unit: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Text:
    """`"a text"`, its escapes resolved."""

    value: str
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Bool:
    """`yes` or `no`."""

    value: bool
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class List:
    """`[a, b]` as a value."""

    items: tuple[Value, ...]
    span: Span


Value = Name | Number | Quantity | Text | Bool | List


@dataclass(frozen=True, slots=True, kw_only=True)
class Argument:
    """`policy: nearest`, given to a block or a category."""

    name: Name
    value: Value
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """`dose: mass = 50 mg`, declared by an action or a hook, or for missions or trips."""

    name: Name
    type: Name
    default: Value | None
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Use:
    """`use pluto_survey as survey`."""

    package: Name
    alias: Name | None
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class VersionDecl:
    """`version "1.2.0"`."""

    version: Text
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class RequiresDecl:
    """`requires "numpy>=2", "requests>=2.32"`: at least one text."""

    libraries: tuple[Text, ...]
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class FieldsDecl:
    """`mission has patient: text, …`: at least one field."""

    on: str
    """`mission` or `trip`."""
    fields: tuple[Parameter, ...]
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class ResultDecl:
    """`result measure as heat(quantity: "pm10", …)`."""

    action: Name
    way: Name
    arguments: tuple[Argument, ...]
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class CategoryDecl:
    """`category scout(payload: 5 g) can take_photo`."""

    name: Name
    arguments: tuple[Argument, ...]
    can: tuple[Name, ...]
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class EventDecl:
    """`event intruder(kind: text = "person")`."""

    name: Name
    fields: tuple[Parameter, ...]
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionDecl:
    """`action spray(dose: mass = 50 mg) -> float once takes 20 s`; `repeat` is the word alone, if any."""

    name: Name
    parameters: tuple[Parameter, ...]
    returns: Name | None
    repeat: Name | None
    takes: Value | None
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class HookDecl:
    """`evaluator NAME(…)`, `policy NAME`, `creator NAME`, `modifier NAME(…) emits … writes …`."""

    kind: str
    """`evaluator`, `modifier`, `policy` or `creator`."""
    name: Name
    parameters: tuple[Parameter, ...]
    emits: tuple[Name, ...]
    writes: tuple[Name, ...]
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockDecl:
    """`launch = TripLauncher`, `scan = survey.GridScan(spacing: 2 m)`."""

    name: Name
    prefix: Name | None
    kind: Name
    arguments: tuple[Argument, ...]
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Stop:
    """One stop of a flow: a name, or several in brackets."""

    names: tuple[Name, ...]
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Guard:
    """`when STANDBY, FAILED`; `otherwise` has no statuses."""

    statuses: tuple[Name, ...]
    otherwise: bool
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowDecl:
    """`a -> [b, c] -> d when STANDBY`: at least two stops."""

    stops: tuple[Stop, ...]
    guard: Guard | None
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class BadStatement:
    """What cannot be read, up to the next statement. A tree without mistakes has none."""

    kind: str | None
    """`block`, `flow`, or the word that it begins with, where that is clear."""
    name: Name | None
    """What it certainly declares."""
    head: str | None
    """What stands where a block's name should be, where that is no name."""
    span: Span


Setting = VersionDecl | RequiresDecl
"""What stands once in an app, and has no name."""

Statement = (
    Setting
    | FieldsDecl
    | ResultDecl
    | CategoryDecl
    | EventDecl
    | ActionDecl
    | HookDecl
    | BlockDecl
    | FlowDecl
    | BadStatement
)


@dataclass(frozen=True, slots=True, kw_only=True)
class AppDecl:
    """`app NAME ["Title"] { … }`."""

    name: Name
    """Its text is empty where it cannot be read."""
    title: Text | None
    statements: tuple[Statement, ...]
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class File:
    """A whole source."""

    source: Source
    uses: tuple[Use, ...]
    app: AppDecl
    bad: tuple[BadStatement, ...] = ()
    """What cannot be read outside of the app's braces."""
