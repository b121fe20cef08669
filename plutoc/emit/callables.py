"""The functions that `flow.py` calls, with names that do not clash."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from typing import Any

from plutoc.block import IN_GRAPH, Choice
from plutoc.emit.embed import OURS, Carried
from plutoc.emit.python import Import
from plutoc.graph.model import Node
from plutoc.plan.bodies import branches, steps
from plutoc.plan.model import Call, Join, Plan, Watch
from plutoc_runtime.flow.run import watch

RESERVED = frozenset(
    {
        *("APP", "App", "BUILT_IN", "CATEGORIES", "FIELDS", "Mission", "Parameter"),
        *("AlongAction", "CompanyOf", "Creator", "EVENTS", "EventsOf", "FOLLOW", "TracksOf"),
        *(
            "OwnAction",
            "Photo",
            "Run",
            "Status",
            "Trip",
            "Type",
            "at",
            "declared",
            "flow",
            "hooks",
            "mission",
        ),
        "partial",
        *("bool", "float", "int", "str"),
        *("run", "status"),
        *(status.name for status in IN_GRAPH),
    }
)
"""The names that `flow.py` gives to other things."""

Names = Mapping[Carried, str]

WATCH = Carried(package=OURS, function=watch)
"""The one wait for the end of a trip."""


def carried_functions(plan: Plan) -> tuple[Carried, ...]:
    """Return every function of an installed package that the flow calls, in source order."""
    functions = (plan.body, *(branch.body for branch in branches(plan.body)))
    called: set[str] = set()
    limits: set[str] = set()
    found: dict[Carried, None] = {}
    for step in (step for body in functions for step in steps(body)):
        match step:
            case Call(node=node) | Join(gate=node):
                called.add(node.name)
            case Watch(watchers=watchers):
                limits.update(node.name for node in watchers)
                found[WATCH] = None
            case _:
                pass
    for node in plan.checked.graph.nodes:
        own = [node.step, *_chosen(node)] if node.name in called else []
        if node.limit is not None and node.name in limits:
            own += [node.limit] if node.name in called else [node.limit, *_chosen(node)]
        found |= dict.fromkeys(Carried(package=node.package, function=one) for one in own)
    return tuple(found)


def chosen(node: Node, choice: Choice) -> tuple[Callable[..., Any] | None, str | None]:
    """Return the function for a choice, and the hook that it makes one of, if any.

    The function is None where the hook is handed on as it is.
    """
    value = dict(node.choices)[choice.name]
    if value.hook is None:
        return choice.options[value.name], None
    return choice.adapt, value.hook.name


def _chosen(node: Node) -> list[Callable[..., Any]]:
    choices = [param for param in node.block.params if isinstance(param, Choice)]
    functions = [chosen(node, choice)[0] for choice in choices]
    return [function for function in functions if function is not None]


def names_of(functions: tuple[Carried, ...]) -> Names:
    """Return what each function is called in `flow.py`.

    Where a name is taken, those of other packages get their package's name before it, so that a
    further package in the graph renames nothing of ours.
    """
    wanted = Counter(name for name, _ in {(one.name, one.home) for one in functions})
    taken = set(RESERVED)
    names: dict[Carried, str] = {}
    for one in sorted(functions, key=lambda one: one.package != OURS):
        free = one.name not in RESERVED and not one.name.startswith("_")
        plain = free and (wanted[one.name] == 1 or one.package == OURS)
        names[one] = _free(one.name if plain else f"{one.package}_{one.name.strip('_')}", taken)
        taken.add(names[one])
    return names


def _free(name: str, taken: set[str]) -> str:
    number, free = 1, name
    while free in taken:
        number += 1
        free = f"{name}_{number}"
    return free


def imports_of(names: Names) -> list[Import]:
    """Return the imports of the functions."""
    return [
        Import(module=one.home, name=one.name, alias=name if name != one.name else None)
        for one, name in names.items()
    ]
