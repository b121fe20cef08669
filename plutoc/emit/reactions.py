"""What a package says of events: a class for each that the app declares, and what makes missions of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from plutoc.emit.python import (
    PYTHON,
    Import,
    annotation,
    builtins_alias,
    call,
    docstring,
    items,
    literal,
    names,
    shadows,
)
from plutoc.emit.written import parameter
from plutoc.graph.model import Event, Graph, Hook

HOME = "._runtime.events.declared"
ANY = "Event"
"""The class of the built-in events, and the base of all others."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EventClass:
    """The class of an event that the app declares."""

    name: str
    declaration: str
    doc: str
    lines: list[str]
    """A field a line."""
    entry: str
    """Its line in the table of events."""


def classes(graph: Graph) -> list[EventClass]:
    """Return a class for each event of an app's own."""
    named = class_names(graph)
    return [
        EventClass(
            name=named[event.name],
            declaration=event.declaration,
            doc=docstring(f"The event {event.name}."),
            lines=list(_fields(event)),
            entry=_entry(event, named[event.name]),
        )
        for event in graph.events
    ]


def class_names(graph: Graph) -> Mapping[str, str]:
    """Return the name of each event's class: `SmokeAlarmEvent` of `smoke_alarm`."""
    named: dict[str, str] = {}
    often: Counter[str] = Counter()
    for event in graph.events:
        short = f"{_in_pascal_case(event.name)}Event"
        often[short] += 1
        named[event.name] = short if often[short] == 1 else f"{short}{often[short]}"
    return named


def _in_pascal_case(name: str) -> str:
    return "".join(part[:1].upper() + part[1:] for part in name.split("_"))


def _fields(event: Event) -> Iterator[str]:
    taken = {field.name for field in event.fields}
    for field in sorted(event.fields, key=lambda one: one.default is not None):
        default = f" = {literal(field.default)}" if field.default is not None else ""
        yield f"{field.name}: {annotation(PYTHON[field.type], taken)}{default}"


def _entry(event: Event, name: str) -> str:
    arguments = [f"name={literal(event.name)}", f"type={name}"]
    if event.fields:
        arguments.append(f"fields={items(map(parameter, event.fields))}")
    return call("EventType", arguments)


def imports(graph: Graph) -> list[Import]:
    """Return what `model.py` imports for them."""
    if not graph.events:
        return []
    found = [*names(HOME, ANY, "EventType")]
    if any(event.fields for event in graph.events):
        found += names("._runtime.domain.actions", "Parameter")
        found += names("._runtime.domain.quantities", "Type")
    for event in graph.events:
        taken = {field.name for field in event.fields}
        if shadows(taken, (PYTHON[field.type] for field in event.fields)):
            alias = builtins_alias(taken)
            found.append(Import(module="builtins", alias=None if alias == "builtins" else alias))
    return found


def taken_by(graph: Graph, hook: Hook) -> tuple[str, ...]:
    """Return the classes of the events that a creator is called with."""
    named = class_names(graph)
    blocks = {node.name for node in graph.nodes if node.hook is hook}
    events = [edge.source for edge in graph.edges if edge.target in blocks]
    if not events or not all(event in named for event in events):
        return (ANY,)
    return tuple(dict.fromkeys(named[event] for event in events))


def creators(graph: Graph) -> Iterator[str]:
    """Yield what is called when an event comes, an event and a block each."""
    for edge in graph.edges:
        node = graph.node.get(edge.target)
        if edge.source in graph.sources and node is not None and node.hook is not None:
            arguments = (
                f"event={literal(edge.source)}",
                f"block={literal(node.name)}",
                f"hook=hooks.{node.hook.name}",
            )
            yield call("Creator", arguments)


def exports(graph: Graph) -> dict[str, str]:
    """Return the classes that hooks are written with, and where they are."""
    if not graph.reacts:
        return {}
    return {
        ANY: HOME,
        "Context": "._runtime.events.context",
        **dict.fromkeys(class_names(graph).values(), ".model"),
    }


def parts(graph: Graph, along: str) -> str:
    """Return the argument with what the app has beside missions and drones; `along`: its own actions on the way."""
    made = "".join(f"{one}," for one in creators(graph))
    events = [
        *(["types=EVENTS"] if graph.events else []),
        *([f"creators=({made})"] if made else []),
    ]
    company = [f"own=({along})"] if along else []
    return f"parts=({call('EventsOf', events)}, TracksOf(), {call('CompanyOf', company)})"


def parts_imports(graph: Graph, written: str) -> list[Import]:
    """Return what `flow.py` imports for them."""
    imports = [
        *names("._runtime.events.raising", "EventsOf"),
        *names("._runtime.events.tracks", "TracksOf"),
        *names("._runtime.events.company", "CompanyOf"),
    ]
    if graph.events:
        imports += names(".model", "EVENTS")
    if "Creator(" in written:
        imports += names(HOME, "Creator")
    if "AlongAction(" in written:
        imports += names("._runtime.events.declared", "AlongAction")
    if graph.follows:
        imports += names("._runtime.events.follow", "FOLLOW")
    return imports
