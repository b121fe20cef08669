"""The page of a block, made of its declaration: for the terminal and for docs/blocks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from inspect import cleandoc

from plutoc.block import IN_GRAPH, AnyParam, Block, Choice, EventParam, HookParam, Param
from plutoc_runtime.domain.fields import Field, FieldType
from plutoc_runtime.domain.quantities import Type, units_of
from plutoc_runtime.domain.status import Status


def first_line(block: Block) -> str:
    """Return what a block does, in a sentence."""
    return cleandoc(block.doc).partition("\n")[0]


def page(name: str, block: Block) -> str:
    """Return a block's page in Markdown; `name` is how an app writes its kind."""
    sections = [f"# {name}", cleandoc(block.doc), *_statuses(block)]
    sections += _section("Parameters", [param_line(param) for param in block.params])
    sections += _section("Fields it brings", [_field(field) for field in block.needs])
    if block.uses:
        used = _all(f"`{field}`" for field in block.uses)
        sections.append(f"It also looks at {used}, where another block brings that in.")
    return "\n\n".join(sections) + "\n"


def _section(title: str, items: list[str]) -> Iterator[str]:
    if items:
        yield f"## {title}"
        yield "\n".join(items)


def _statuses(block: Block) -> Iterator[str]:
    """Show what comes out for what goes in."""
    rows = [
        f"| {status.value}{guard} | {_listed(table[status])} |"
        for guard, table in (("", block.transitions), (", by a guard only", block.guarded))
        for status in IN_GRAPH
        if status in table
    ]
    yield "\n".join(["| accepts | emits |", "|---|---|", *rows])
    for narrowed in block.narrowed:
        value = f"{narrowed.param}: {_value(narrowed.value)}"
        yield f"With `{value}` it emits no more than {_listed(narrowed.emits)}."
    if block.emits_by_hook:
        yield "If its hook declares `emits`, it emits exactly those."


def param_line(param: AnyParam) -> str:
    """Return a line about a parameter, as a page has it."""
    match param:
        case Param():
            return f"- `{param.name}`: {_type(param)}{_default(param)}. {param.doc}"
        case Choice():
            options = _all((f"`{option}`" for option in param.options), "or")
            own = f", or a {param.hook.value} hook of yours" if param.hook else ""
            return f"- `{param.name}`: {options}{own}; default `{param.default}`. {param.doc}"
        case HookParam():
            need = "" if param.required else "; may be left out"
            return f"- `{param.name}`: {_a(param.kind.value)} hook of yours{need}. {param.doc}"
        case EventParam():
            return f"- `{param.name}`: an event. {param.doc}"


def _type(param: Param) -> str:
    units = units_of(param.type)
    plain = _TYPES.get(param.type) or _a(param.type.value)
    text = f"{plain} ({', '.join(units)})" if units else plain
    return text if param.least is None else f"{text}, at least {_number(param.least)}"


_TYPES = {
    Type.INT: "a whole number",
    Type.FLOAT: "a number",
    Type.BOOL: "yes or no",
    Type.TEXT: "a text",
}


def _default(param: Param) -> str:
    if param.required:
        return "; must be given"
    return "" if param.default is None else f"; default {_in_si(param.default, param.type)}"


def _in_si(value: bool | float | str, kind: Type) -> str:
    unit = {
        Type.TIME: " s",
        Type.LENGTH: " m",
        Type.MASS: " kg",
        Type.ANGLE: " rad",
        Type.SPEED: " m/s",
        Type.TEMPERATURE: " K",
    }.get(kind, "")
    return f"`{_value(value)}{unit}`"


def _field(field: Field) -> str:
    default = "" if field.default is None else f"; default {_value(field.default)}"
    return f"- `{field.name}` of a {field.on.value}: {_FIELDS[field.type]}{default}. {field.doc}"


_FIELDS: dict[FieldType | Type, str] = {
    FieldType.TIME: "a time",
    FieldType.INT: "a whole number",
    FieldType.ROUNDS: "a number of rounds, or true",
    FieldType.TIME_OF_DAY: 'a time of day, such as "08:00"',
    FieldType.EVALUATOR: "the name of an evaluator",
}


def _value(value: bool | float | str) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value if isinstance(value, str) else _number(value)


def _number(value: float) -> str:
    return f"{value:g}"


def _listed(statuses: frozenset[Status]) -> str:
    return ", ".join(status.value for status in IN_GRAPH if status in statuses)


def _all(words: Iterable[str], last: str = "and") -> str:
    every = list(words)
    return f" {last} ".join([", ".join(every[:-1]), every[-1]] if len(every) > 1 else every)


def _a(word: str) -> str:
    return f"{'an' if word[0] in 'aeiou' else 'a'} {word}"
