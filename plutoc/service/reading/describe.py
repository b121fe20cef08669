"""What the words of the language mean, in Markdown: for hovering, and beside completions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType

from plutoc.block import IN_GRAPH, AnyParam, Block, Param
from plutoc.graph import built_in
from plutoc.graph.categories import PARAMS
from plutoc.graph.hooks import PHOTO
from plutoc.graph.model import Action, AppField, Category, Event, Hook, Node, Parameter, Plain
from plutoc.graph.values import EXAMPLES
from plutoc.report.block_page import page, param_line
from plutoc.syntax.texts import quoted
from plutoc_runtime.domain.actions import Parameter as Declared
from plutoc_runtime.domain.quantities import UNITS, Type, units_of
from plutoc_runtime.domain.status import Status

KEYWORDS: Mapping[str, str] = MappingProxyType(
    {
        "pluto": "The version of the language, on the first line: `pluto 1`.",
        "use": "Brings in an installed package of blocks; its kinds are written with its prefix.",
        "as": "Gives a package a shorter prefix.",
        "app": "Begins the app: its name is that of its package, its title what people read.",
        "category": "Declares drones of one shape: what they carry, how they fly, which actions they can.",
        "can": "Which actions the drones of a category can do.",
        "action": "Declares an action of the app's own: a function in hooks.py.",
        "evaluator": "Declares a hook that judges a finished mission, and may add trips.",
        "modifier": "Declares a hook that changes a mission on its way, or only looks at it.",
        "policy": "Declares a hook that chooses the drone for a trip.",
        "event": "Declares what can happen; it leads to what makes a mission of it, as `start` does.",
        "creator": "Declares a hook that makes a mission of an event.",
        "emits": "With which statuses a mission can leave a modifier.",
        "writes": "Which attributes of the mission a modifier changes.",
        "when": "The guard of an arrow: it takes these statuses and no others.",
        "otherwise": "Takes every status that no other arrow of the block takes.",
        "version": "The version of the app's package, as PEP 440 writes versions.",
        "requires": "What must be installed for the hooks, as PEP 508 writes requirements.",
        "mission": "`mission has …` declares fields that the users of the app fill in for missions.",
        "trip": "`trip has …` declares fields that the users of the app fill in for trips.",
        "has": "Behind `mission` or `trip`: fields, each with its type, and with a default or none.",
        "result": "Says what the results of an action are, and how they are shown.",
        "takes": "How long an action takes, for plans and batteries: a time, or a parameter that is one.",
        "safe": "The action may be repeated after a crash of the system.",
        "once": "The action is not repeated after a crash of the system.",
        "ask": "After a crash a person decides whether the action is repeated.",
        "along": "The action is done on the way, from the launch to the end of the last leg.",
        "start": "Where every mission begins: it leads to the block that makes missions.",
        "end": "Where missions end: it takes COMPLETED and FAILED.",
        "yes": "True.",
        "no": "False.",
    }
)
"""The words of the language, in a sentence each."""

STATUSES: Mapping[Status, str] = MappingProxyType(
    {
        Status.UNEXECUTED: "The mission has not begun: none of its trips has flown.",
        Status.RUNNING: "A trip of the mission is being flown.",
        Status.STANDBY: "A trip is over, and the mission has more of them to fly.",
        Status.COMPLETED: "All trips of the mission are done.",
        Status.FAILED: "A trip, and so the mission, has failed.",
        Status.PAUSED: "The mission is paused by a person. It exists outside of the graph.",
        Status.CANCELLED: "The mission was cancelled. It exists outside of the graph.",
        Status.UNCERTAIN: "A person must say what became of it. It exists outside of the graph.",
        Status.HELD: "The mission waits for a person. It exists outside of the graph.",
    }
)

ACTIONS: Mapping[str, str] = MappingProxyType(
    {
        "measure": "Measures a quantity, and gives a number.",
        "take_photo": "Takes a photo, and gives it.",
        "pick_item": "Picks an item up.",
        "release_item": "Lets the item go.",
        "follow": "Stays within reach of what moves, for so long, and takes pictures.",
    }
)

_WHOSE = {"follow": "Drones of a category that names it can do it."}
_PLAIN = {
    Type.INT: "a whole number",
    Type.FLOAT: "a number",
    Type.BOOL: "`yes` or `no`",
    Type.TEXT: "a text in quotes",
}
_UNIT_OF_HOOK = {
    Type.MASS: "kilograms",
    Type.LENGTH: "metres",
    Type.TIME: "seconds",
    Type.ANGLE: "radians",
    Type.PERCENT: "a share from 0 to 1",
    Type.SPEED: "metres a second",
    Type.TEMPERATURE: "kelvin",
}


def code(text: str) -> str:
    """Return source text as a block of Markdown."""
    return f"```pluto\n{text}\n```"


def paragraphs(parts: Iterable[str]) -> str:
    """Join what is not empty."""
    return "\n\n".join(part for part in parts if part)


def listed(statuses: Iterable[Status]) -> str:
    """Say statuses in the order in which they are declared."""
    known = set(statuses)
    return ", ".join(f"`{status.value}`" for status in IN_GRAPH if status in known) or "none"


def of_kind(written: str, block: Block) -> str:
    """Describe a kind of block: its page."""
    return page(written, block)


def of_any_param(param: AnyParam) -> str:
    """Describe a parameter of a kind."""
    return param_line(param).removeprefix("- ")


def of_type(kind: Type) -> str:
    """Describe a type of parameters."""
    units = ", ".join(f"`{unit}`" for unit in units_of(kind))
    if not units:
        return f"{code(kind.value)}\n\nWritten as {_PLAIN[kind]}: `{EXAMPLES[kind]}`."
    return paragraphs(
        (
            code(kind.value),
            f"Written with a unit, {units}: `{EXAMPLES[kind]}`.",
            f"Hooks get it in {_UNIT_OF_HOOK[kind]}.",
        )
    )


def of_unit(unit: str) -> str:
    """Describe a unit."""
    kind, factor, offset = UNITS[unit]
    plain = [other for other in units_of(kind) if UNITS[other][1:] == (1.0, 0.0)]
    said = f"1 {unit} is {factor + offset:.6g} {plain[0]}" if plain and plain != [unit] else ""
    return f"`{unit}`: a {kind.value}{f'; {said}' if said else ''}."


def of_status(status: Status) -> str:
    """Describe a status."""
    return f"**{status.value}**: {STATUSES[status]}"


def of_hook(declaration: str, signature: str) -> str:
    """Describe a hook: its declaration, and the function that it is."""
    stub = f"```python\n{signature}\n```" if signature else ""
    return paragraphs((code(declaration), stub))


def of_action(name: str) -> str:
    """Describe a built-in action."""
    action = built_in.ACTIONS[name]
    given = ", ".join(f"{p.name}: {p.type.value}{_default(p)}" for p in action.parameters)
    declared = f"action {name}{f'({given})' if given else ''} {action.repeat}"
    return paragraphs((code(declared), ACTIONS[name], _WHOSE.get(name, "Every app has it.")))


def of_event(name: str, event: Event | None, creators: Iterable[str]) -> str:
    """Describe an event: its declaration, or what it means, and what makes missions of it."""
    leads = ", ".join(f"`{one}`" for one in creators)
    return paragraphs(
        (
            code(event.declaration) if event else f"`{name}`: {built_in.EVENTS.get(name, '')}",
            "" if event else "Every app has it.",
            f"It leads to {leads}." if leads else "",
        )
    )


def _default(one: Declared) -> str:
    return "" if one.default is None else f" = {in_units(one.default, one.type)}"


def of_param(param: Param) -> str:
    """Describe a parameter of a category, or of how results are shown."""
    default = "" if param.default is None else f"; default {in_units(param.default, param.type)}"
    units = f" ({', '.join(units_of(param.type))})" if units_of(param.type) else ""
    return f"`{param.name}`: a {param.type.value}{units}{default}. {param.doc}"


def of_parameter(parameter: Parameter, owner: str) -> str:
    """Describe a parameter that an action or a hook declares."""
    default = (
        ""
        if parameter.default is None
        else f"; default {in_units(parameter.default, parameter.type)}"
    )
    unit = (
        f" Hooks get it in {_UNIT_OF_HOOK[parameter.type]}."
        if parameter.type in _UNIT_OF_HOOK
        else ""
    )
    return f"`{parameter.name}`: {parameter.type.value} of `{owner}`{default}.{unit}"


def of_field(field: AppField) -> str:
    """Describe a field that the app declares for its missions or trips."""
    written = describe_default(field)
    need = (
        "It must be filled in, in missions files and on a station."
        if field.default is None
        else "It may be left out."
    )
    unit = f" Hooks get it in {_UNIT_OF_HOOK[field.type]}." if field.type in _UNIT_OF_HOOK else ""
    read = f"Hooks read it as `{field.on.value}.{field.name}`."
    return paragraphs((code(f"{field.on.value} has {written}"), f"{need}{unit} {read}"))


def describe_default(field: AppField | Parameter) -> str:
    """Write a field or a parameter as an app declares it."""
    default = "" if field.default is None else f" = {in_units(field.default, field.type)}"
    return f"{field.name}: {field.type.value}{default}"


def of_photo(name: str) -> str:
    """Describe the type of what an action gives that no parameter can be."""
    return f"{code(name)}\n\nWhat `take_photo` gives: a `Photo` in hooks." if name == PHOTO else ""


def of_category(category: Category) -> str:
    """Describe a category: all of its values, also those that are not written."""
    values = (getattr(category, param.name) for param in PARAMS)
    rows = [
        f"- {param.name}: {in_units(value, param.type)}"
        for param, value in zip(PARAMS, values, strict=True)
    ]
    return paragraphs((code(category.declaration), "\n".join(rows)))


def in_units(value: Plain, kind: Type) -> str:
    """Write a value in SI units as an app would: in the largest unit in which it is a short number."""
    units = units_of(kind)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return quoted(value)
    if not units:
        return f"{value:g}"
    ways = []
    for unit in units:
        _, factor, offset = UNITS[unit]
        number = f"{(value - offset) / factor:.6g}"
        ways.append(
            (len(number.replace(".", "")) + (abs(float(number)) < 0.1), -factor, number, unit)
        )
    _, _, number, unit = min(ways)
    return f"{number} {unit}"


def of_block(node: Node, arriving: Iterable[Status], leaving: Iterable[Status]) -> str:
    """Describe a block: its declaration, the statuses that pass through it, its kind's page."""
    written = node.block.name if node.package == "std" else f"{node.package}.{node.block.name}"
    passing = f"Missions arrive with {listed(arriving)} and leave with {listed(leaving)}."
    return paragraphs((code(node.declaration), passing, of_kind(written, node.block)))


def hook_declaration(hook: Hook | Action) -> str:
    """Write what a hook declares."""
    if isinstance(hook, Action):
        return hook.declaration
    given = ", ".join(map(describe_default, hook.parameters))
    emits = f" emits {', '.join(s.value for s in hook.emits)}" if hook.emits else ""
    writes = f" writes {', '.join(hook.writes)}" if hook.writes else ""
    return f"{hook.kind.value} {hook.name}{f'({given})' if given else ''}{emits}{writes}"


def in_si(value: float, kind: Type) -> str:
    """Say a number as hooks get it."""
    return f"{value:g} ({_UNIT_OF_HOOK[kind]})"
