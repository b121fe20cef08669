"""Tree → graph: every name resolved, every value in SI units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from plutoc.block import IN_GRAPH, HookKind, HookParam
from plutoc.diagnostic import Diagnostic, Severity, accept_or_raise
from plutoc.graph import categories, errors, event_errors, hooks
from plutoc.graph.built_in import ACTIONS, EVENTS
from plutoc.graph.cascades import each_name_once, told_once
from plutoc.graph.chosen import without_a_value
from plutoc.graph.edges import edges
from plutoc.graph.fields import fields
from plutoc.graph.model import FIRST_VERSION, Action, Event, Graph, Hook, Node
from plutoc.graph.nodes import Place, node
from plutoc.graph.packages import packages_of, unused_packages
from plutoc.graph.results import results
from plutoc.graph.scope import (
    check_app_name,
    is_built_in_along,
    scope_of,
    spoilt_names,
)
from plutoc.graph.settings import libraries, version
from plutoc.graph.stops import meant_to_declare
from plutoc.graph.uncertain_names import bad_statements, uncertain_names
from plutoc.graph.values import written
from plutoc.registry import STD, Blocks
from plutoc.source import Source
from plutoc.syntax.tree import (
    ActionDecl,
    BlockDecl,
    Bool,
    CategoryDecl,
    EventDecl,
    File,
    FlowDecl,
    HookDecl,
    Name,
    Statement,
)


def resolve(file: File, blocks: Blocks) -> tuple[Graph, tuple[Diagnostic, ...]]:
    """Return the graph of a source, and warnings; raise `Rejected` with all errors."""
    graph, found = resolved(file, blocks)
    return graph, accept_or_raise(found)


def resolved(file: File, blocks: Blocks) -> tuple[Graph, list[Diagnostic]]:
    """Return as much of a source's graph as is clear, and all that is wrong with its names."""
    source, statements = file.source, file.app.statements
    found: list[Diagnostic] = []
    scope = scope_of(file, found)
    unsure = uncertain_names(file, spoilt_names(source, found))
    if not any(bad.kind == "app" for bad in file.bad):
        check_app_name(source, file.app.name, found)
    packages = packages_of(file, blocks, found)
    actions: list[Action] = []
    app_hooks: list[Hook] = []
    events: list[Event] = []
    along: dict[str, None] = {}
    partial: set[str] = set()
    for declared in statements:
        before = len(found)
        match declared:
            case ActionDecl() if is_built_in_along(declared):
                along[hooks.along_built_in(source, declared, found)] = None
            case ActionDecl():
                actions.append(hooks.action(source, declared, found))
                along |= {actions[-1].name: None} if actions[-1].along else {}
            case EventDecl():
                events.append(hooks.event(source, declared, found))
            case HookDecl():
                app_hooks.append(hooks.hook(source, declared, found))
            case _:
                continue
        if len(found) > before:
            partial.add(declared.name.text)
    known_actions = dict.fromkeys([*ACTIONS, *(action.name for action in actions)])
    category_decls = [s for s in statements if isinstance(s, CategoryDecl)]
    place = Place(
        source=source,
        scope=scope,
        hooks={hook.name: hook for hook in (*map(_as_hook, actions), *app_hooks)},
        events=dict.fromkeys([*(event.name for event in events), *EVENTS]),
        partial=frozenset(partial),
        packages=packages,
        unclear=unsure,
        found=found,
    )
    block_decls = [s for s in statements if isinstance(s, BlockDecl)]
    nodes = [each for each in (node(place, one) for one in block_decls) if each is not None]
    by_name = {each.name: each for each in reversed(nodes)}
    flows = [s for s in statements if isinstance(s, FlowDecl)]
    kinds = packages.kinds[STD] or {}
    slips = meant_to_declare(source, flows, scope, kinds, found)
    flows = [flow for flow in flows if flow not in slips.values()]
    unsure = replace(unsure, names=unsure.names | slips.keys())
    found.extend(without_a_value(source, statements, nodes, app_hooks, partial))
    number = version(file, found)
    graph = Graph(
        source=source,
        name=file.app.name.text,
        name_span=file.app.name.span,
        title=_title(file),
        categories=tuple(
            categories.category(source, declared, known_actions, unsure, found)
            for declared in category_decls
        )
        or (categories.implicit(),),
        fields=fields(source, statements, nodes, found),
        events=tuple(events),
        actions=tuple(actions),
        along=tuple(along),
        results=results(source, statements, actions, partial, unsure, found),
        hooks=tuple(app_hooks),
        nodes=tuple(nodes),
        edges=edges(source, flows, scope, by_name, place.events, unsure, found),
        version=number.value if number else FIRST_VERSION,
        version_span=number.span if number else None,
        libraries=libraries(file, found),
        kinds=tuple(kinds.values()),
    )
    if not bad_statements(file) and not any(d.severity is Severity.ERROR for d in found):
        # Else a mistake may be what keeps it from being used.
        found.extend(unused_packages(file))
        found.extend(_unused_hooks(source, app_hooks, nodes, block_decls))
        found.extend(_unused_actions(source, actions, category_decls, block_decls))
        found.extend(_unused_events(source, statements, flows, block_decls))
    fixed = {*kinds, *(status.value for status in IN_GRAPH)}
    return graph, told_once(source, each_name_once(found), {*scope, *ACTIONS, *EVENTS}, fixed)


def _as_hook(action: Action) -> Hook:
    """A block of a package may call an action, as it calls any hook."""
    return Hook(
        kind=HookKind.ACTION,
        name=action.name,
        parameters=action.parameters,
        emits=(),
        writes=(),
        span=action.span,
    )


def _title(file: File) -> str:
    """Return the title, or one made of the name: "Crop watch" of `crop_watch`."""
    title = file.app.title.value.strip() if file.app.title else ""
    return title or file.app.name.text.replace("_", " ").capitalize()


def _unused_hooks(
    source: Source, declared: Sequence[Hook], nodes: Sequence[Node], blocks: Sequence[BlockDecl]
) -> list[Diagnostic]:
    """Find hooks that nothing calls. An evaluator can be a mission's own choice, by its plan."""
    named = _named(blocks)
    judged = any(
        isinstance(param, HookParam) and param.kind is HookKind.EVALUATOR
        for node in nodes
        for param in node.block.params
    )
    return [
        errors.unused_hook(source, Name(text=hook.name, span=hook.span), hook.kind.value)
        for hook in declared
        if hook.name not in named and not (judged and hook.kind is HookKind.EVALUATOR)
    ]


def _unused_actions(
    source: Source,
    actions: Sequence[Action],
    declared: Sequence[CategoryDecl],
    blocks: Sequence[BlockDecl],
) -> list[Diagnostic]:
    """Find actions that no drone can do; without a category, every drone can do everything."""
    used = _named(blocks) | {name.text for category in declared for name in category.can}
    return [
        errors.unused_action(source, Name(text=action.name, span=action.span))
        for action in actions
        if declared and not action.along and action.name not in used
    ]


def _unused_events(
    source: Source,
    statements: Sequence[Statement],
    flows: Sequence[FlowDecl],
    blocks: Sequence[BlockDecl],
) -> list[Diagnostic]:
    """Find events that nothing waits for."""
    drawn = {name.text for flow in flows for stop in flow.stops for name in stop.names}
    return [
        event_errors.unused_event(source, declared)
        for declared in statements
        if isinstance(declared, EventDecl) and declared.name.text not in drawn | _named(blocks)
    ]


def _named(blocks: Sequence[BlockDecl]) -> set[str]:
    """Return the names that blocks are given as values."""
    values = [argument.value for block in blocks for argument in block.arguments]
    return {written(value) for value in values if isinstance(value, Name | Bool)}
